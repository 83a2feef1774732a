#pragma once

// What a node's transform does to its shape.

#include <optional>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_double4x4.hpp>

namespace abut::tool {

bool is_finite(const glm::dmat4& matrix);

/// Without mirroring, to within the margin of every answer.
bool is_rotation(const glm::dmat3& matrix);

/// How an object has turned since its shape was baked; nothing where it has done more than turn.
std::optional<glm::dmat3> turn_since(const glm::dmat3& baked, const glm::dmat3& now);

}  // namespace abut::tool
