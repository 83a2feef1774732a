#pragma once

// Hulls with a vertex limit: convex sets around the points, with nearly the minimum volume for their number of corners.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_options.hpp>
#include <abut/math/affine.hpp>

#include <optional>

namespace abut::detail {

/// As `hull`, with options. If the hull exceeds the limit, the corners of the result are not input points. Every input
/// point lies in the convex hull of the corners, exactly, and below the `offsets`. A Problem `too_large` if corners
/// would leave the range of floats.
Result<Hull2> limited_hull(std::span<const Vec2> points, const HullOptions& options);

/// The hull with a vertex limit in 3D. Coplanar points stay in their plane. Seen along the axis nearest to its normal
/// each point lies in the result, exactly, and it is off the plane by no more than those of `hull` are.
Result<Hull3> limited_hull(std::span<const Vec3> points, const HullOptions& options);

/// A polygon of at most `limit` corners, 3 or more, around the corners of a hull with an area (as `Hull2` has them).
/// Its area is at most that of the minimum oriented rectangle, measured after the map `seen`, to the rounding of
/// floats; for 3 corners twice that. Nothing if corners would leave the range of floats.
std::optional<Hull2> outline_of(std::span<const Vec2> hull_points, std::size_t limit, const Affine<2>& seen);

/// `full` is the flat hull of the points, with more than `limit` corners. The result lies in the same plane. Seen along
/// the axis nearest to the plane's normal, it contains each point exactly, and each point is below both of its faces.
/// Nothing if it would leave the range of floats, or if floats have no points near the plane.
std::optional<Hull3> limited_flat_hull(const Hull3& full, std::span<const Vec3> points, std::size_t limit);

/// The problem if corners would leave the range of floats.
inline Problem beyond_floats() {
    return {ProblemCode::too_large, "so few corners that hold all points are beyond the range of floats", 0};
}

}  // namespace abut::detail
