#pragma once

// The hull of a few corners around many points, at any thickness.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/limited/stretched_frame.hpp>

#include <optional>
#include <span>

namespace abut::detail {

/// The hull of corners with a volume. The faces are decided in the frame, where the hull isn't thin. Normals, offsets
/// and sizes are those of the world, and the offsets bound the points as well. Nothing if a point lies outside of the
/// corners' hull, which is decided exactly.
std::optional<Hull3> hull_in_frame(std::span<const Vec3> corners, std::span<const Vec3> points,
                                   const StretchedFrame<3>& frame);

}  // namespace abut::detail
