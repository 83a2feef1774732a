#pragma once

// The corners that meet at a point of a walk mesh. Not for users.

#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_links.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// Points at which corners meet that no edge joins, in increasing order. Points are welded.
std::vector<std::uint32_t> pinched_points(std::span<const glm::uvec3> triangles, const WalkLinks& links);

struct WalkNormals {
    std::vector<Vec3> normals;
    std::vector<glm::uvec3> of;  ///< by triangle
};

/// One normal a fan of corners that agree which side is up. Weights are those of Max, "Weights for Computing Vertex
/// Normals from Facet Normals" (1999): right on spheres, and without angles.
WalkNormals fan_normals(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, const WalkLinks& links);

}  // namespace abut
