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

#include <type_traits>

namespace abut::detail {

/// Whether shapes of this kind have a core of convex/pairs/placed_cores.hpp.
constexpr bool has_core(ShapeKind kind) {
    return kind == ShapeKind::ball || kind == ShapeKind::capsule || kind == ShapeKind::segment ||
           kind == ShapeKind::box;
}

/// The core of a plain shape, without its pose.
template <class Core>
[[gnu::always_inline]] inline Core core_in_place(const ShapeRef<3>& given) {
    using namespace lanes;
    if constexpr (std::is_same_v<Core, PlacedBox>) {
        const Box3& box = given.as<Box3>();
        return {box.center, box.half, box.rotation};
    } else if constexpr (std::is_same_v<Core, PlacedBall>) {
        const Sphere& ball = given.as<Sphere>();
        return {loaded(ball.center), loaded_twice(ball.radius)};
    } else {
        // A segment has the members of a capsule but the radius.
        static constexpr float none = 0;
        const bool round = given.kind == ShapeKind::capsule;
        const Vec3& from = round ? given.as<Capsule3>().a : given.as<Segment<3>>().a;
        const Vec3& to = round ? given.as<Capsule3>().b : given.as<Segment<3>>().b;
        return {loaded(from), loaded(to), loaded_twice(*(round ? &given.as<Capsule3>().radius : &none))};
    }
}

/// With its pose, like `convex(shape, pose)`.
template <class Core>
Core core_of(const ShapeRef<3>& given) {
    if (given.pose == nullptr) return core_in_place<Core>(given);
    if constexpr (std::is_same_v<Core, PlacedBox>) {
        const Box3& box = given.as<Box3>();
        return {convex(box, *given.pose).place, 1, box.half, 0};
    } else {
        Affine<3> place;
        set_affine(place, *given.pose);
        const auto put_in_place = [&](lanes::Double3& point) {
            point = lanes::double3(place.point(lanes::vector(point)));
        };
        Core core = core_in_place<Core>(given);
        if constexpr (std::is_same_v<Core, PlacedBall>) {
            put_in_place(core.center);
        } else {
            put_in_place(core.from);
            put_in_place(core.to);
        }
        return core;
    }
}

/// Calls visit(type_identity<core of A>, type_identity<core of B>) for kinds of shapes that have cores. Returns its
/// answer, or `otherwise`.
template <class Answer, class Visit>
constexpr Answer with_kinds(ShapeKind a, ShapeKind b, Answer otherwise, const Visit& visit) {
    const auto with_kind = [](ShapeKind kind, const auto& go_on) {
        if (kind == ShapeKind::box) return go_on(std::type_identity<PlacedBox>());
        if (kind == ShapeKind::ball) return go_on(std::type_identity<PlacedBall>());
        return go_on(std::type_identity<PlacedSegment>());
    };
    if (!has_core(a) || !has_core(b)) return otherwise;
    return with_kind(a, [&](auto kind_a) { return with_kind(b, [&](auto kind_b) { return visit(kind_a, kind_b); }); });
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

[[gnu::always_inline]] inline PairAnswer overlap_of(const PlacedBox& a, const PlacedBox& b, Cache* cache) {
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
template <class Visit>
bool with_cores(const Convex<3>& a, const Convex<3>& b, const Visit& visit) {
    return has_core(a) && has_core(b) && with_core(a, [&](const auto& core_a) {
               return with_core(b, [&](const auto& core_b) { return visit(core_a, core_b); });
           });
}

inline bool distance_of_cores(const Convex<3>& a, const Convex<3>& b, Cache* cache, CoresDistance& found) {
    return with_cores(a, b, [&](const auto& x, const auto& y) { return distance_of(x, y, cache, found); });
}

inline PairAnswer overlap_of_cores(const Convex<3>& a, const Convex<3>& b, Cache* cache) {
    PairAnswer answer = PairAnswer::unknown;
    with_cores(a, b, [&](const auto& x, const auto& y) {
        answer = overlap_of(x, y, cache);
        return true;
    });
    return answer;
}

}  // namespace abut::detail
