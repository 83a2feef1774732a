#pragma once

// Balls, segments and boxes in space, each with a ball around it or not: one closed form for each pair, entered from
// plain shapes or from views. For .cpp files.

#include <abut/convex/pairs/box3.hpp>
#include <abut/convex/pairs/round3-inl.h>
#include <abut/math/detail/set_affine.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/segment.hpp>

namespace abut::detail {

/// Whether the shape has a core of convex/pairs/placed_cores.hpp.
inline bool has_core(const ShapeRef<3>& given) {
    return given.kind == ShapeKind::ball || given.kind == ShapeKind::capsule || given.kind == ShapeKind::segment ||
           given.kind == ShapeKind::box;
}

inline PlacedSegment placed_segment(const Vec3& from, const Vec3& to, const float& radius, const Pose3* pose) {
    using namespace lanes;
    if (pose == nullptr) return {loaded(from), loaded(to), loaded_twice(radius)};
    Affine<3> place;
    set_affine(place, *pose);
    return {double3(place.point(DVec<3>(from))), double3(place.point(DVec<3>(to))), loaded_twice(radius)};
}

/// Places each like `convex(shape, pose)`.
template <class Visit>
inline bool with_core(const ShapeRef<3>& given, const Visit& visit) {
    using namespace lanes;
    if (given.kind == ShapeKind::box) {
        const Box3& box = given.as<Box3>();
        if (given.pose == nullptr) return visit(PlacedBox(box.center, box.half, box.rotation));
        return visit(PlacedBox(convex(box, *given.pose).place, 1, box.half, 0));
    }
    if (given.kind == ShapeKind::ball) {
        const Sphere& ball = given.as<Sphere>();
        if (given.pose == nullptr) return visit(PlacedBall{loaded(ball.center), loaded_twice(ball.radius)});
        return visit(PlacedBall{double3(placed<3>(DVec<3>(ball.center), *given.pose)), loaded_twice(ball.radius)});
    }
    if (given.kind == ShapeKind::segment)
        return visit(placed_segment(given.as<Segment<3>>().a, given.as<Segment<3>>().b, 0, given.pose));
    const Capsule3& capsule = given.as<Capsule3>();
    return visit(placed_segment(capsule.a, capsule.b, capsule.radius, given.pose));
}

inline bool distance_of(const PlacedBox& a, const PlacedBox& b, Cache* cache, CoresDistance& found) {
    return distance_of_boxes(a, b, cache, found);
}
template <class A, class B>
bool distance_of(const A& a, const B& b, Cache*, CoresDistance& found) {
    return distance_of(a, b, found) && lanes::finite(found.distance);
}

/// Whether a cheap test proves that the distance is above `within`.
template <class A, class B>
bool are_apart(const A& a, const B& b, double within) {
    if constexpr (std::is_same_v<A, PlacedBox> && std::is_same_v<B, PlacedSegment>)
        return is_beyond_a_face(a, b, within);
    else if constexpr (std::is_same_v<A, PlacedSegment> && std::is_same_v<B, PlacedBox>)
        return is_beyond_a_face(b, a, within);
    else
        return false;
}

inline PairAnswer overlap_of(const PlacedBox& a, const PlacedBox& b, Cache* cache) {
    return boxes_overlap(a, b, cache);
}
template <class A, class B>
PairAnswer overlap_of(const A& a, const B& b, Cache*) {
    if (are_apart(a, b, 0)) return PairAnswer::no;
    CoresDistance found;
    if (!distance_of(a, b, nullptr, found)) return PairAnswer::unknown;
    return found.distance[0] <= 0 ? PairAnswer::yes : PairAnswer::no;
}

/// Calls visit(core of A, core of B), which returns bool. Returns false for other shapes.
template <class Shape, class Visit>
bool with_cores(const Shape& a, const Shape& b, const Visit& visit) {
    return has_core(a) && has_core(b) && with_core(a, [&](const auto& core_a) {
               return with_core(b, [&](const auto& core_b) { return visit(core_a, core_b); });
           });
}

template <class Shape>
bool distance_of_cores(const Shape& a, const Shape& b, Cache* cache, CoresDistance& found) {
    return with_cores(a, b, [&](const auto& x, const auto& y) { return distance_of(x, y, cache, found); });
}

template <class Shape>
PairAnswer overlap_of_cores(const Shape& a, const Shape& b, Cache* cache) {
    PairAnswer answer = PairAnswer::unknown;
    with_cores(a, b, [&](const auto& x, const auto& y) {
        answer = overlap_of(x, y, cache);
        return true;
    });
    return answer;
}

}  // namespace abut::detail
