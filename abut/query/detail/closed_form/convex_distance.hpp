#pragma once

// The signed distance of a pair in closed form, as exact as GJK and EPA: a ball against a ball, a segment, a triangle,
// a box, a polygon of few edges or the inside of a polyhedron; a segment or capsule against another, a triangle or a
// box. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>

namespace abut::detail {

/// Returns false, and leaves `result` unspecified, if the pair has no closed form, or none that is certain. `result`
/// must be newly constructed: corners with index 0 aren't written.
template <int D>
bool closed_form_distance(const Convex<D>& a, const Convex<D>& b, SignedDistance<D>& result);

}  // namespace abut::detail
