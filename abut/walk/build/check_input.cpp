#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/walk/build/check_input.hpp>

#include <cmath>
#include <cstddef>
#include <string>

namespace abut::detail {
namespace {

constexpr std::size_t max_triangles = std::size_t{1} << 28;
constexpr float max_coordinate = 1e15f;

}  // namespace

std::optional<Problem> problem_of_walk_mesh(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                            std::span<const Vec3> normals, std::span<const std::uint8_t> areas) {
    if (std::optional<Problem> problem = problem_of_faces<3>(points, triangles, "a walk mesh")) return problem;
    if (triangles.size() >= max_triangles)
        return Problem{ProblemCode::too_large, "a walk mesh has fewer than 2^28 triangles"};
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int a = 0; a < 3; ++a)
            if (std::abs(points[i][a]) > max_coordinate)
                return Problem{ProblemCode::too_large, "point " + std::to_string(i) + " has a coordinate above 1e15",
                               i};
    const auto count_mismatch = [](std::size_t given, std::size_t needed, const char* of, const char* needs) {
        return std::to_string(given) + of + std::to_string(needed) + needs;
    };
    if (!normals.empty() && normals.size() != points.size())
        return Problem{ProblemCode::bad_argument,
                       count_mismatch(normals.size(), points.size(), " normals of ", " points")};
    if (!areas.empty() && areas.size() != triangles.size())
        return Problem{ProblemCode::bad_argument,
                       count_mismatch(areas.size(), triangles.size(), " areas of ", " triangles")};
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (!is_finite(normals[i]))
            return Problem{ProblemCode::not_finite, "normal " + std::to_string(i) + " is not finite", i};
    return std::nullopt;
}

}  // namespace abut::detail
