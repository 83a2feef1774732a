#pragma once

// Bullet's approximate convex decomposition: HACD (Mamou, Ghorbel 2009), which clusters triangles.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

/// The vertices of each part's hull. Stops at this many clusters, or at more if no clusters can be merged.
std::vector<std::vector<Vec3>> hacd_parts(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                          std::size_t clusters, std::size_t corners);

}  // namespace abut::bench
