#pragma once

// Pairs of convex shapes of size about 1, placed at a wanted distance from one another.

#include "../test/oracle/random.hpp"
#include <abut/query/closest.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cstddef>
#include <variant>
#include <vector>

namespace abut::scenes {

/// About the origin of its own frame, a capsule along its y axis.
using AnyConvex = std::variant<Box3, Capsule3, Polyhedron>;

struct Placed {
    std::size_t shape;
    Pose3 pose;
};
struct PlacedPair {
    Placed a, b;
};

/// Shapes, and pairs of them by index.
struct ConvexPairs {
    std::vector<AnyConvex> shapes;
    std::vector<PlacedPair> pairs;
};

inline Box3 random_box(oracle::Random& random) {
    return {Vec3(0),
            {random.uniform_float(0.25, 1), random.uniform_float(0.25, 1), random.uniform_float(0.25, 1)},
            no_rotation<3>};
}

inline Capsule3 random_capsule(oracle::Random& random) {
    const float half = random.uniform_float(0.25, 1);
    return {{0, -half, 0}, {0, half, 0}, random.uniform_float(0.1, 0.5)};
}

/// The hull of points on a sphere of radius 1: each is a corner.
inline Polyhedron random_hull(oracle::Random& random, std::size_t corners) {
    std::vector<Vec3> points;
    while (points.size() < corners) points.push_back(to_float<3>(random.direction<3>()));
    return *Polyhedron::build(points);
}

inline Box3 placed(const Box3& box, const Pose3& pose) {
    return {pose * box.center, box.half, pose.rotation};
}
inline Capsule3 placed(const Capsule3& capsule, const Pose3& pose) {
    return {pose * capsule.a, pose * capsule.b, capsule.radius};
}
inline At<const Polyhedron&> placed(const Polyhedron& hull, const Pose3& pose) {
    return at(hull, pose);
}

/// Turned at random. B is put down far off in a random direction and brought near along the line of closest approach,
/// until the gap is one between `low` and `high`, evenly; below zero, as deep along that line. No gap is within 0.01 of
/// zero: what touches is beyond doubt.
template <class S>
ConvexPairs random_pairs(const std::vector<S>& shapes, std::size_t count, double low, double high,
                         oracle::Random& random) {
    ConvexPairs result;
    result.shapes.assign(shapes.begin(), shapes.end());
    const auto any = [&] { return random.below(static_cast<std::uint32_t>(shapes.size())); };
    while (result.pairs.size() < count) {
        const double gap = random.uniform(low, high);
        if (-0.01 < gap && gap < 0.01) continue;
        const Placed a{any(), {to_float<3>(random.in_cube<3>() * 10.0), random.rotation<3>()}};
        Placed b{any(), {a.pose.position + to_float<3>(random.direction<3>() * 5.0), random.rotation<3>()}};
        const Closest<3> closest = abut::closest(placed(shapes[a.shape], a.pose), placed(shapes[b.shape], b.pose));
        b.pose.position += (static_cast<float>(gap) - closest.distance) * closest.normal;
        result.pairs.push_back({a, b});
    }
    return result;
}

/// Stacked boxes: B lies on a face of A, turned about its normal and sunk in by 0.01 to 0.03.
inline ConvexPairs stacked_boxes(std::size_t count, oracle::Random& random) {
    ConvexPairs result;
    for (std::size_t i = 0; i < count; ++i) {
        const Box3 below = random_box(random), above = random_box(random);
        const Pose3 pose{to_float<3>(random.in_cube<3>() * 10.0), random.rotation<3>()};
        const Vec3 offset{random.uniform_float(-0.2, 0.2),
                          below.half.y + above.half.y - random.uniform_float(0.01, 0.03),
                          random.uniform_float(-0.2, 0.2)};
        const glm::quat about_normal = turn_about({0, 1, 0}, random.uniform_float(0, 6.28));
        result.shapes.emplace_back(below);
        result.shapes.emplace_back(above);
        result.pairs.push_back({{2 * i, pose}, {2 * i + 1, pose * Pose3{offset, about_normal}}});
    }
    return result;
}

}  // namespace abut::scenes
