#pragma once

// The pairs whose signed distance has a closed form as right as the searches: a point with a ball around it against
// another, a segment, a triangle, a box or a polygon of few sides, or deep in a polyhedron; a segment against another,
// a triangle or a box. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>

namespace abut {

/// False, and `result` is of no use, where the pair has none, or none that is beyond doubt. A new `result` is expected:
/// corners numbered 0 are left as they are.
template <int D>
bool closed_form(const Convex<D>& a, const Convex<D>& b, SignedDistance<D>& result);

}  // namespace abut
