#pragma once

// Validation of the input of a walk mesh. Not for users.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstdint>
#include <optional>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// The Problems of WalkMesh::build, except for `degenerate`.
std::optional<Problem> problem_of_walk_mesh(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                            std::span<const Vec3> normals, std::span<const std::uint8_t> areas);

}  // namespace abut::detail
