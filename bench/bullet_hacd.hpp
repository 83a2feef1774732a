#pragma once

// The approximate decomposition that comes with Bullet: HACD (Mamou, Ghorbel 2009), clusters of triangles.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

/// The corners of each part's hull. It stops at so many clusters, or at more where it can't join any further.
std::vector<std::vector<Vec3>> hacd_parts(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                          std::size_t clusters, std::size_t corners);

}  // namespace abut::bench
