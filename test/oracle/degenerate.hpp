#pragma once

// Degenerate pairs: shapes with corners on a small lattice. They share faces, edges and corners, coincide, are
// concentric, have zero thickness or collinear points.

#include "distance.hpp"
#include "sample.hpp"

namespace abut::oracle {

/// The change of a lattice pair's coordinates before the test.
enum class Perturbation {
    none,       ///< coordinates are small whole numbers times a power of two: touching is exact
    rotated,    ///< both shapes by one pose, which rounds
    nudged,     ///< each coordinate by a few ulp
    flattened,  ///< one axis a thousand to a million times smaller than the others
};
inline constexpr int perturbation_count = 4;

template <int D>
class LatticeGenerator {
public:
    LatticeGenerator(Random& random, Perturbation perturbation) : random_(random), perturbation_(perturbation) {
        unit_ = Vec<D>(std::ldexp(1.0f, static_cast<int>(random.below(21)) - 10));
        if (perturbation == Perturbation::flattened)
            unit_[static_cast<int>(random.below(D))] *= static_cast<float>(random.power_of_two(-20, -10));
        if (perturbation == Perturbation::rotated) {
            pose_.rotation = random.rotation<D>();
            pose_.position = point();
        }
    }

    Sample<D> make() {
        const float radius = static_cast<float>(random_.below(3)) * unit_[0];
        const Vec<D> a = point(), b = point(), c = point();
        switch (random_.below(8)) {
            case 0:
                return placed(Kind::ball, Ball<D>{a, radius}, {a}, radius);
            case 1:
                return placed(Kind::capsule, Capsule<D>{a, b, radius}, {a, b}, radius);
            case 2:
                return placed(Kind::segment, Segment<D>{a, b}, {a, b});
            case 3:
                return placed(Kind::triangle, Triangle<D>{a, b, c}, {a, b, c});
            case 4:
                return placed(Kind::rounded_triangle, rounded(Triangle<D>{a, b, c}, radius), {a, b, c}, radius);
            case 5: {
                const std::vector<Vec<D>> points = point_set();
                return placed(Kind::cloud, PointCloud<D>{points}, points);
            }
            case 6: {
                const std::vector<Vec<D>> points = point_set();
                return placed(Kind::polytope, *BuiltHull<D>::build(points), points);
            }
            default:
                return box(a, b);
        }
    }

private:
    Vec<D> point() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) {
            result[i] = static_cast<float>(static_cast<int>(random_.below(5)) - 2) * unit_[i];
            if (perturbation_ == Perturbation::nudged)
                for (std::uint32_t step = random_.below(3); step > 0; --step)
                    result[i] = std::nextafter(result[i], random_.chance(0.5) ? 1e9f : -1e9f);
        }
        return result;
    }
    std::vector<Vec<D>> point_set() {
        std::vector<Vec<D>> points;
        for (std::uint32_t i = 1 + random_.below(8); i > 0; --i) points.push_back(point());
        return points;
    }

    template <class S>
    Sample<D> placed(Kind kind, S shape, std::vector<Vec<D>> points, float radius = 0) {
        return sample<D>(kind, at(std::move(shape), pose_),
                         mapped(hull_of<D>(std::move(points), static_cast<double>(radius)), detail::affine(pose_)));
    }
    Sample<D> box(const Vec<D>& center, const Vec<D>& half) {
        const Box<D> box{center, abs(half)};
        return sample<D>(
            Kind::box, At<Box<D>>{box, pose_},
            mapped(box_of<D>(detail::affine(Pose<D>{box.center, box.rotation}), box.half), detail::affine(pose_)));
    }
    static Vec<D> abs(Vec<D> v) {
        for (int i = 0; i < D; ++i) v[i] = std::abs(v[i]);
        return v;
    }

    Random& random_;
    Perturbation perturbation_;
    Vec<D> unit_;
    Pose<D> pose_;
};

}  // namespace abut::oracle
