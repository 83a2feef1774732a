#pragma once

// Fans of triangles around the vertices of a walk mesh. Not for users.

#include <abut/walk/build/edge_links.hpp>
#include <abut/walk/data.hpp>

#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// Vertices with more than one fan of triangles, ascending. Points are welded.
std::vector<std::uint32_t> non_manifold_vertices(std::span<const glm::uvec3> triangles, const WalkLinks& links);

struct WalkNormals {
    std::vector<Vec3> normals;
    std::vector<glm::uvec3> of;  ///< one per triangle
};

/// One normal per fan of consistently oriented corners, with the weights of Max, "Weights for Computing Vertex Normals
/// from Facet Normals" (1999): exact on spheres, and without angles.
WalkNormals fan_normals(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, const WalkLinks& links);

}  // namespace abut::detail
