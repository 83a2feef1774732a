#pragma once

// Classification of node transforms.

#include <optional>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_double4x4.hpp>

namespace abut::tool {

bool is_finite(const glm::dmat4& matrix);

/// True for a proper rotation, to within the tolerance of queries.
bool is_rotation(const glm::dmat3& matrix);

/// The rotation since the shape was baked; nothing if the change is more than a rotation.
std::optional<glm::dmat3> rotation_since(const glm::dmat3& baked, const glm::dmat3& now);

}  // namespace abut::tool
