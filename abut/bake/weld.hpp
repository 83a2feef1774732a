#pragma once

// Files give each face corners of its own; whether faces meet is told by where their corners are.

#include <abut/math/vec.hpp>

#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

struct Welded {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

/// The same triangles in the same order, points at exactly the same position made one, points that no triangle uses
/// left out, the others in the order of their first use. -0 becomes 0. Triangles with two equal corners go. Indices are
/// in range, coordinates not NaN. O(n log n).
Welded weld(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace abut
