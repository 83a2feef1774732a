#pragma once

// Hulls with a vertex limit of coplanar points in 3D.

#include <abut/convex/hull/hull.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace abut::detail {

/// `full` is the flat hull of the points, with more than `limit` corners. The result lies in the same plane. Seen along
/// the axis nearest to the plane's normal, it contains each point exactly, and each point is below both of its faces.
/// Nothing if it would leave the range of floats, or if floats have no points near the plane.
std::optional<Hull3> limited_flat_hull(const Hull3& full, std::span<const Vec3> points, std::size_t limit);

}  // namespace abut::detail
