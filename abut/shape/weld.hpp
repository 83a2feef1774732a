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

/// The same where points at most `distance` apart, finite and not below 0, count as one: each in the order of the
/// points becomes the nearest of those that were kept before it, or is kept itself. So no point is moved farther than
/// the distance, and those left are farther apart than that. O(n) but for points that are chosen to collide.
Welded weld(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, double distance);

}  // namespace abut
