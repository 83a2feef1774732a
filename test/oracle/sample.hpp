#pragma once

// Random shapes of every kind that is a polytope with a ball around it, as the library sees them and as the oracle
// does.

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

enum class Kind {
    ball,
    capsule,
    segment,
    triangle,
    box,
    aabb,
    rounded_box,
    cloud,
    turned_capsule,
    stretched_box,
    rounded_triangle,
    polytope,
};
inline constexpr int kind_count = 12;

/// A shape, kept alive, in both forms.
template <int D>
struct Sample {
    Kind kind;
    std::shared_ptr<const void> keeper;
    View<D> view;
    Polytope<D> solid;
};

/// A set of points as a user's own shape, known by its support function.
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
    auto keeper = std::make_shared<const S>(std::move(shape));
    return {kind, keeper, abut::view(*keeper), std::move(solid)};
}

/// Makes the shapes of a kind. The same numbers make the same shape at another center.
template <int D>
class Maker {
public:
    Maker(Random random, const DVec<D>& center, double size) : random_(random), center_(center), size_(size) {}

    Sample<D> make(Kind kind) {
        const float radius = random_.uniform_float(0.05 * size_, 0.7 * size_);
        switch (kind) {
            case Kind::ball: {
                const Vec<D> center = point(0);
                const float whole = static_cast<float>(size_);
                return sample<D>(kind, Ball<D>{center, whole}, hull_of<D>({center}, static_cast<double>(whole)));
            }
            case Kind::capsule: {
                const Vec<D> a = point(0.7), b = point(0.7);
                return sample<D>(kind, Capsule<D>{a, b, radius}, hull_of<D>({a, b}, static_cast<double>(radius)));
            }
            case Kind::segment: {
                const Vec<D> a = point(1), b = point(1);
                return sample<D>(kind, Segment<D>{a, b}, hull_of<D>({a, b}));
            }
            case Kind::triangle: {
                const Vec<D> a = point(1), b = point(1), c = point(1);
                return sample<D>(kind, Triangle<D>{a, b, c}, hull_of<D>({a, b, c}));
            }
            case Kind::box: {
                const Box<D> box{point(0), half(), random_.rotation<D>()};
                return sample<D>(kind, box, box_of<D>(affine(Pose<D>{box.center, box.rotation}), box.half));
            }
            case Kind::aabb: {
                const Vec<D> middle = point(0), extent = half();
                const Aabb<D> box{middle - extent, middle + extent};
                return sample<D>(kind, box, box_between(box.min, box.max));
            }
            case Kind::rounded_box: {
                const Box<D> box{point(0), half() * 0.5f, random_.rotation<D>()};
                return sample<D>(
                    kind, rounded(Box<D>(box), radius),
                    box_of<D>(affine(Pose<D>{box.center, box.rotation}), box.half, static_cast<double>(radius)));
            }
            case Kind::cloud: {
                std::vector<Vec<D>> points;
                for (std::uint32_t i = D + 1 + random_.below(7); i > 0; --i) points.push_back(point(1));
                return sample<D>(kind, PointCloud<D>{points}, hull_of<D>(points));
            }
            case Kind::polytope: {
                std::vector<Vec<D>> points;
                for (std::uint32_t i = D + 1 + random_.below(7); i > 0; --i) points.push_back(point(1));
                return sample<D>(kind, *BuiltHull<D>::build(points), hull_of<D>(points));
            }
            case Kind::turned_capsule: {
                const Pose<D> pose{point(0), random_.rotation<D>()};
                const Vec<D> a = local(0.7), b = local(0.7);
                return sample<D>(kind, at(Capsule<D>{a, b, radius}, pose),
                                 mapped(hull_of<D>({a, b}, static_cast<double>(radius)), affine(pose)));
            }
            case Kind::stretched_box: {
                const Pose<D> pose{point(0), random_.rotation<D>()};
                const Box<D> box{local(0.1), half() * 0.5f, random_.rotation<D>()};
                const Vec<D> scale = local(2) / static_cast<float>(size_);
                const Affine<D> place = affine(pose) * scaling(scale) * affine(Pose<D>{box.center, box.rotation});
                return sample<D>(kind, at(stretched(Box<D>(box), scale), pose), box_of<D>(place, box.half));
            }
            case Kind::rounded_triangle: {
                const Vec<D> a = point(0.7), b = point(0.7), c = point(0.7);
                return sample<D>(kind, rounded(Triangle<D>{a, b, c}, radius),
                                 hull_of<D>({a, b, c}, static_cast<double>(radius)));
            }
        }
        return {};
    }

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
