#pragma once

// Closed forms of queries of two plain shapes, without views of them: circles, capsules, segments, triangles, boxes and
// polygons of few edges in the plane; spheres, capsules and boxes in space. Up to rounding the answers are those of
// pair_dispatch.hpp. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/pairs/pair_answer.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/hit.hpp>
#include <abut/shape/box.hpp>

#include <optional>

namespace abut::detail {

PairAnswer closed_form_overlap(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache);

/// A sweep of two plain shapes in the plane. The answer is `unknown` for shapes that touch at the start, slide or
/// graze. `result` is written only if the answer is `yes`.
PairAnswer closed_form_sweep(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b, const Vec2& motion_b,
                             std::optional<Hit<2>>& result);

/// The signed distance of a pair of views, as exact as GJK and EPA: a ball against a ball, a segment, a triangle, a box
/// or the inside of a polyhedron; a segment or capsule against another, a triangle or a box. The answer is `no` if a
/// cheap test proves that the distance is above `reach`, and `unknown` if the pair has no closed form, or none that is
/// certain. `result` is written only if the answer is `yes`, or else unspecified. It must be newly constructed: corners
/// with index 0 aren't written.
PairAnswer closed_form_distance(const Convex<3>& a, const Convex<3>& b, double reach, Cache* cache,
                                SignedDistance<3>& result);

}  // namespace abut::detail
