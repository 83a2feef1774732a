#include <abut/shape/check_triangles.hpp>
#include <abut/walk/walk_check.hpp>

#include <cmath>
#include <cstddef>
#include <string>

namespace abut {
namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 28;
constexpr float most_coordinate = 1e15f;

}  // namespace

std::optional<Problem> problem_of_walk_mesh(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                            std::span<const Vec3> normals, std::span<const std::uint8_t> areas) {
    if (std::optional<Problem> problem = problem_of_triangles(points, triangles, "a walk mesh")) return problem;
    if (triangles.size() >= most_triangles)
        return Problem{ProblemCode::too_large, "a walk mesh has fewer than 2^28 triangles"};
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int a = 0; a < 3; ++a)
            if (std::abs(points[i][a]) > most_coordinate)
                return Problem{ProblemCode::too_large, "point " + std::to_string(i) + " has a coordinate above 1e15",
                               i};
    const auto as_many = [](std::size_t given, std::size_t needed, const char* of, const char* needs) {
        return std::to_string(given) + of + std::to_string(needed) + needs;
    };
    if (!normals.empty() && normals.size() != points.size())
        return Problem{ProblemCode::bad_argument, as_many(normals.size(), points.size(), " normals of ", " points")};
    if (!areas.empty() && areas.size() != triangles.size())
        return Problem{ProblemCode::bad_argument, as_many(areas.size(), triangles.size(), " areas of ", " triangles")};
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (!is_finite(normals[i]))
            return Problem{ProblemCode::not_finite, "normal " + std::to_string(i) + " is not finite", i};
    return std::nullopt;
}

}  // namespace abut
