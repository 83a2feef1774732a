#pragma once

// Tests whether triangles are the surface of a convex body.

#include <abut/math/vec.hpp>

#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// True if the triangles are the closed surface of a convex body, oriented outwards: every edge is shared by two
/// triangles in opposite directions, the volume is positive, and no point lies in front of a triangle's plane by more
/// than 1e-5 times the size. The body is then the convex hull of the points. A room or a sky box, oriented inwards, is
/// none.
///
/// Points are welded (see `weld`), all used and finite; indices are in range. Concave surfaces are mostly rejected
/// early; for convex ones the time is about that of their hull.
bool is_convex_solid(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

/// The volume that a closed surface encloses, negative if it is oriented inwards. Meaningless for an open surface.
double signed_volume(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace abut
