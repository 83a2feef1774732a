#pragma once

// Is a heap of triangles the surface of a convex body?

#include <abut/math/vec.hpp>

#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// True where the triangles are the closed surface of a convex body, wound outwards: every edge is shared by two
/// triangles that run along it in opposite directions, the volume is above zero, and no point lies in front of any
/// triangle's plane by more than 1e-5 x the size. The body is then the convex hull of the points.
/// A room or a sky box, seen from inside, is none. Points are welded (see `weld`), all used, finite; indices in range.
/// Leaves early on what isn't convex; on what is, takes about as long as its hull.
bool is_convex_solid(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

/// The volume a closed surface bounds: above zero where it is wound outwards, below where it is seen from inside.
/// Of an open one it means nothing.
double signed_volume(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace abut
