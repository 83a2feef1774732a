#pragma once

// The hull of a few corners that hold many points, however thin it is.

#include <abut/convex/hull.hpp>
#include <abut/convex/stretched_frame.hpp>

#include <optional>
#include <span>

namespace abut {

/// The hull of corners with a volume. Which of them make a face is decided in the frame, where it is as thick as it is
/// long; normals, offsets and sizes are those of the world, the offsets for the points as well. Nothing where a point
/// lies outside of the corners' hull, which is decided exactly.
std::optional<Hull3> framed_hull(std::span<const Vec3> corners, std::span<const Vec3> points,
                                 const StretchedFrame<3>& frame);

}  // namespace abut
