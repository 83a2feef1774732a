#pragma once

// Checks of triangles (in 2D of segments) from outside: indices and coordinates, and degenerate triangles.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include <glm/ext/vector_uint2.hpp>
#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// Returns a Problem if there is no triangle (in 2D no segment), if a coordinate isn't finite or if an index is out of
/// range. The message names the point or triangle; `what` is its subject, such as "a mesh".
template <int D>
std::optional<Problem> problem_of_faces(std::span<const Vec<D>> points,
                                        std::span<const glm::vec<D, std::uint32_t>> faces, std::string_view what);

/// True if the triangle has no area: two corners are equal, or all three lie on a line to within 1e-12 of the longest
/// edge.
bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace abut::detail
