#pragma once

// Random convex shapes of size about 1, each about the origin of its own frame.

#include "../test/oracle/random.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>

#include <cstddef>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>

namespace abut::scenes {

/// A capsule lies along its y axis.
template <int D>
using AnyConvex =
    std::conditional_t<D == 2, std::variant<Circle, Box2, Polygon>, std::variant<Sphere, Box3, Capsule3, Polyhedron>>;

template <int D>
Ball<D> random_ball(oracle::Random& random) {
    return {Vec<D>(0), random.uniform_float(0.25, 1)};
}

template <int D>
Box<D> random_box(oracle::Random& random) {
    Box<D> box;
    for (int i = 0; i < D; ++i) box.half[i] = random.uniform_float(0.25, 1);
    return box;
}

inline Capsule3 random_capsule(oracle::Random& random) {
    const float half = random.uniform_float(0.25, 1);
    return {{0, -half, 0}, {0, half, 0}, random.uniform_float(0.1, 0.5)};
}

template <int D>
std::vector<Vec<D>> random_directions(oracle::Random& random, std::size_t count) {
    std::vector<Vec<D>> result;
    while (result.size() < count) result.push_back(detail::to_float<D>(random.direction<D>()));
    return result;
}

/// The hull of points on the unit sphere: each is a vertex.
inline Polyhedron random_hull(oracle::Random& random, std::size_t corners) {
    return *Polyhedron::build(random_directions<3>(random, corners));
}

/// The hull of points on the unit circle: each is a vertex, far enough from the next that no library welds them.
inline Polygon random_polygon(oracle::Random& random, std::size_t corners) {
    for (;;) {
        const Polygon polygon = *Polygon::build(random_directions<2>(random, corners));
        const std::span<const Vec2> points = polygon.points();
        if (points.size() < corners || polygon.area() < 0.25) continue;
        bool clear = true;
        for (std::size_t i = 0; i < corners; ++i) clear &= glm::distance(points[i], points[(i + 1) % corners]) > 0.05f;
        if (clear) return polygon;
    }
}

template <int D>
Ball<D> placed(const Ball<D>& ball, const Pose<D>& pose) {
    return {pose * ball.center, ball.radius};
}
template <int D>
Box<D> placed(const Box<D>& box, const Pose<D>& pose) {
    return {pose * box.center, box.half, pose.rotation};
}
inline Capsule3 placed(const Capsule3& capsule, const Pose3& pose) {
    return {pose * capsule.a, pose * capsule.b, capsule.radius};
}
inline At<const Polygon&> placed(const Polygon& polygon, const Pose2& pose) {
    return at(polygon, pose);
}
inline At<const Polyhedron&> placed(const Polyhedron& hull, const Pose3& pose) {
    return at(hull, pose);
}

}  // namespace abut::scenes
