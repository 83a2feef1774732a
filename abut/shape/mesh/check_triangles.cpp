#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/check_triangles.hpp>

#include <string>

namespace abut::detail {

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

bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const DVec<3> ab = DVec<3>(b) - DVec<3>(a);
    const DVec<3> ac = DVec<3>(c) - DVec<3>(a);
    const DVec<3> bc = DVec<3>(c) - DVec<3>(b);
    const double longest = std::max({length_squared(ab), length_squared(ac), length_squared(bc)});
    const double area = length(cross(ab, ac));
    return area <= 1e-12 * longest;
}

}  // namespace abut::detail
