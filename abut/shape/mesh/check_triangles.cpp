#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/check_triangles.hpp>

#include <string>

namespace abut::detail {

template <int D>
std::optional<Problem> problem_of_faces(std::span<const Vec<D>> points,
                                        std::span<const glm::vec<D, std::uint32_t>> faces, std::string_view what) {
    const std::string face = D == 2 ? "segment" : "triangle";
    if (faces.empty()) return Problem{ProblemCode::empty_input, std::string(what) + " needs at least one " + face, 0};
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!is_finite(points[i]))
            return Problem{ProblemCode::not_finite,
                           "point " + std::to_string(i) + " has a coordinate that is not finite", i};
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int j = 0; j < D; ++j)
            if (faces[i][j] >= points.size())
                return Problem{ProblemCode::index_out_of_range,
                               face + " " + std::to_string(i) + " names point " + std::to_string(faces[i][j]) + " of " +
                                   std::to_string(points.size()),
                               i};
    return std::nullopt;
}

template std::optional<Problem> problem_of_faces<2>(std::span<const Vec2>, std::span<const glm::uvec2>,
                                                    std::string_view);
template std::optional<Problem> problem_of_faces<3>(std::span<const Vec3>, std::span<const glm::uvec3>,
                                                    std::string_view);

bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const DVec<3> ab = DVec<3>(b) - DVec<3>(a);
    const DVec<3> ac = DVec<3>(c) - DVec<3>(a);
    const DVec<3> bc = DVec<3>(c) - DVec<3>(b);
    const double longest = std::max({length_squared(ab), length_squared(ac), length_squared(bc)});
    const double area = length(cross(ab, ac));
    return area <= 1e-12 * longest;
}

}  // namespace abut::detail
