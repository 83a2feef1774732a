#pragma once

// What is wrong with triangles from outside.

#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>

#include <optional>
#include <span>
#include <string_view>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// That there is none, that a coordinate isn't finite, or that a triangle names a point that there isn't; it says
/// which. `what` is what is to be made of them, such as "a mesh".
std::optional<Problem> problem_of_triangles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                            std::string_view what);

}  // namespace abut
