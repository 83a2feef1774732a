#pragma once

// Hulls with a vertex limit of points that lie in a plane of space.

#include <abut/convex/hull.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace abut {

/// `full` is the hull of the points, flat and of more than `limit` corners. The result lies in the same plane: each
/// point lies in it as seen along the axis nearest to the plane's normal, exactly, and below both of its faces. Nothing
/// where it would leave the range of floats, or where floats have no points near the plane.
std::optional<Hull3> limited_flat(const Hull3& full, std::span<const Vec3> points, std::size_t limit);

}  // namespace abut
