#pragma once

// The connected surfaces of a mesh, and what they enclose.

#include <abut/bake/piece.hpp>

#include <span>
#include <vector>

namespace abut {

/// One piece for each: solid where it is closed and wound outwards, with the hollows in it; else a shell `thickness`
/// thick. In the order of their first triangles. Points are welded.
std::vector<Piece> bodies_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, double thickness);

/// The piece, untouched by any plane, is the surface of a convex solid.
bool is_convex(const Piece& body);

}  // namespace abut
