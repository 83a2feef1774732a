#pragma once

// Welding: merges points, so that faces which share positions share vertices.

#include <abut/math/point_span.hpp>
#include <abut/math/vec.hpp>

#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

struct Welded {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

/// Merges points at exactly the same position. Triangles stay in order; unused points are dropped, and the others are
/// in the order of first use. -0 becomes 0. Triangles with two equal corners are removed. Indices must be in range and
/// coordinates not NaN. O(n log n).
Welded weld(const PointSpan<3>& points, std::span<const glm::uvec3> triangles);

/// Merges points that are at most `distance` apart (finite, at least 0). In order, each point is merged into the
/// nearest point retained so far, or is retained. So no point moves farther than `distance`, and retained points are
/// farther apart than that. O(n), except for adversarial hash collisions.
Welded weld(const PointSpan<3>& points, std::span<const glm::uvec3> triangles, double distance);

}  // namespace abut
