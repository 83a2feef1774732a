#pragma once

// The pairs whose signed distance has a closed form as right as the searches: a point with a ball around it against
// another, a segment, a triangle, a box or a polygon of few sides, and two segments that don't cross. For .cpp files.

#include <abut/convex/signed_distance.hpp>

#include <optional>

namespace abut {

/// Nothing where the pair has none.
template <int D>
std::optional<SignedDistance<D>> closed_form(const Convex<D>& a, const Convex<D>& b);

}  // namespace abut
