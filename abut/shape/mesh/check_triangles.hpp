#pragma once

// Checks of triangles from outside: indices and coordinates, and degenerate triangles.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <optional>
#include <span>
#include <string_view>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// Returns a Problem if there is no triangle, if a coordinate isn't finite or if an index is out of range. The message
/// names the point or triangle; `what` is its subject, such as "a mesh".
std::optional<Problem> problem_of_triangles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                            std::string_view what);

/// True if the triangle has no area: two corners are equal, or all three lie on a line to within 1e-12 of the longest
/// edge.
bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace abut::detail
