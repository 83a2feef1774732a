#pragma once

// Random shapes of every kind that is a polytope with a radius, as the library's view and as the oracle's polytope.

#include "polytope.hpp"
#include "random.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <memory>
#include <string>

namespace abut::oracle {

using detail::dot;
using detail::DVec;
using detail::to_float;

enum class Kind {
    ball,
    capsule,
    segment,
    triangle,
    box,
    aabb,
    rounded_box,
    cloud,
    posed_capsule,
    stretched_box,
    rounded_triangle,
    polytope,
};
inline constexpr int kind_count = 12;

/// A shape in both forms, with its owner.
template <int D>
struct Sample {
    Kind kind;
    std::shared_ptr<const void> owner;
    View<D> view;
    Polytope<D> solid;
};

template <int D>
const detail::Convex<D>& convex_of(const Sample<D>& sample) {
    return std::get<detail::Convex<D>>(sample.view);
}

/// A user-defined shape: the hull of points, given by its support function.
template <int D>
struct PointCloud {
    std::vector<Vec<D>> points;

    friend Aabb<D> bounds(const PointCloud& cloud) {
        Aabb<D> result = Aabb<D>::empty();
        for (const Vec<D>& point : cloud.points) result = merged(result, Aabb<D>{point, point});
        return result;
    }
    friend Vec<D> support(const PointCloud& cloud, const Vec<D>& direction) {
        const auto along = [&](const Vec<D>& point) { return dot(DVec<D>(point), DVec<D>(direction)); };
        return *std::max_element(cloud.points.begin(), cloud.points.end(),
                                 [&](const Vec<D>& a, const Vec<D>& b) { return along(a) < along(b); });
    }
};

template <int D>
using BuiltHull = std::conditional_t<D == 2, Polygon, Polyhedron>;

template <int D, class S>
Sample<D> sample(Kind kind, S shape, Polytope<D> solid) {
    auto owner = std::make_shared<const S>(std::move(shape));
    return {kind, owner, abut::view(*owner), std::move(solid)};
}

/// Makes random shapes. Equal random numbers make equal shapes, at any center.
template <int D>
class SampleGenerator {
public:
    SampleGenerator(Random random, const DVec<D>& center, double size)
        : random_(random), center_(center), size_(size) {}

    Sample<D> make(Kind kind);

private:
    Vec<D> point(double spread) { return to_float(center_ + random_.in_cube<D>() * (spread * size_)); }
    Vec<D> local(double spread) { return to_float(random_.in_cube<D>() * (spread * size_)); }
    Vec<D> half() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = random_.uniform_float(0.1 * size_, size_);
        return result;
    }

    Random random_;
    DVec<D> center_;
    double size_;
};

}  // namespace abut::oracle
