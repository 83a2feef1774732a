#include <abut/shape/check_triangles.hpp>

#include <string>

namespace abut {

std::optional<Problem> problem_of_triangles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                            std::string_view what) {
    if (triangles.empty())
        return Problem{ProblemCode::empty_input, std::string(what) + " needs at least one triangle", 0};
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!is_finite(points[i]))
            return Problem{ProblemCode::not_finite,
                           "point " + std::to_string(i) + " has a coordinate that is not finite", i};
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (glm::length_t j = 0; j < 3; ++j)
            if (triangles[i][j] >= points.size())
                return Problem{ProblemCode::index_out_of_range,
                               "triangle " + std::to_string(i) + " names point " + std::to_string(triangles[i][j]) +
                                   " of " + std::to_string(points.size()),
                               i};
    return std::nullopt;
}

}  // namespace abut
