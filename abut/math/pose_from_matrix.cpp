#include <abut/math/affine.hpp>
#include <abut/math/pose_from_matrix.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/ext/quaternion_double.hpp>

namespace abut {

using namespace detail;

namespace {

/// Tolerance of a rotation's axis lengths and of the cosines between axes.
constexpr double tolerance = 1e-4;

/// Tolerance of the last row, which multiplies coordinates.
constexpr double tolerance_of_last_row = 1e-6;

template <int D>
using Matrix = glm::mat<D + 1, D + 1, float>;

template <int D>
Affine<D> upper_rows(const Matrix<D>& matrix) {
    Affine<D> result;
    for (int i = 0; i < D; ++i) {
        for (int j = 0; j < D; ++j) result.column[static_cast<std::size_t>(i)][j] = static_cast<double>(matrix[i][j]);
        result.offset[i] = static_cast<double>(matrix[D][i]);
    }
    return result;
}

template <int D>
std::optional<Problem> problem_of(const Matrix<D>& matrix, const Affine<D>& map) {
    const auto column = [&](int i) -> const DVec<D>& { return map.column[static_cast<std::size_t>(i)]; };
    const auto name = [](int i) { return "axis " + std::to_string(i); };
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    for (int i = 0; i <= D; ++i)
        for (int j = 0; j <= D; ++j)
            if (!std::isfinite(matrix[i][j]))
                return Problem{
                    ProblemCode::not_finite,
                    "column " + std::to_string(i) + " of the matrix isn't finite in row " + std::to_string(j), at(i)};
    for (int i = 0; i <= D; ++i)
        if (!(std::abs(static_cast<double>(matrix[i][D]) - (i == D ? 1 : 0)) <= tolerance_of_last_row))
            return Problem{ProblemCode::bad_argument, "the matrix is a projection: its last row isn't 0 .. 0 1", at(i)};
    for (int i = 0; i < D; ++i)
        if (!(std::abs(length(column(i)) - 1) <= tolerance))
            return Problem{ProblemCode::bad_argument,
                           "the matrix scales: " + name(i) + " has length " + std::to_string(length(column(i))), at(i)};
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < i; ++j)
            if (!(std::abs(dot(column(i), column(j))) <= tolerance))
                return Problem{ProblemCode::bad_argument,
                               "the matrix shears: " + name(j) + " and " + name(i) + " aren't at right angles", at(i)};
    if (determinant(map) < 0) return Problem{ProblemCode::bad_argument, "the matrix mirrors", 0};
    return std::nullopt;
}

/// The rotation nearest to a matrix that is nearly one, normalised.
Turn rotation_of(const Affine<2>& map) {
    const DVec<2> u = normalized(DVec<2>(map.column[0].x + map.column[1].y, map.column[0].y - map.column[1].x));
    return {static_cast<float>(u.x), static_cast<float>(u.y)};
}

/// The nearest rotation in least squares, by averaging the matrix with its inverse transpose (Higham, "Computing the
/// polar decomposition - with applications", 1986); then Shepperd, "Quaternion from rotation matrix", 1978.
glm::quat rotation_of(Affine<3> map) {
    for (int i = 0; i < 2; ++i) {
        const std::array<DVec<3>, 3> c = map.column;
        const double d = determinant(map);
        for (std::size_t axis = 0; axis < 3; ++axis)
            map.column[axis] = (c[axis] + cross(c[(axis + 1) % 3], c[(axis + 2) % 3]) / d) * 0.5;
    }
    const DVec<3>&x = map.column[0], &y = map.column[1], &z = map.column[2];
    // Four times the square of each component; the largest is at least 1.
    const double ww = 1 + x.x + y.y + z.z, xx = 1 + x.x - y.y - z.z, yy = 1 - x.x + y.y - z.z, zz = 1 - x.x - y.y + z.z;
    const double largest_square = std::max({ww, xx, yy, zz});
    glm::dquat q;
    if (largest_square == ww)
        q = {ww, y.z - z.y, z.x - x.z, x.y - y.x};
    else if (largest_square == xx)
        q = {y.z - z.y, xx, x.y + y.x, z.x + x.z};
    else if (largest_square == yy)
        q = {z.x - x.z, x.y + y.x, yy, y.z + z.y};
    else
        q = {x.y - y.x, z.x + x.z, y.z + z.y, zz};
    const double size = square_root(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z) * (q.w < 0 ? -1 : 1);
    return glm::quat(glm::dquat(q.w / size, q.x / size, q.y / size, q.z / size));
}

template <int D>
Result<Pose<D>> pose_of(const Matrix<D>& matrix) {
    const Affine<D> map = upper_rows<D>(matrix);
    if (std::optional<Problem> problem = problem_of<D>(matrix, map)) return *std::move(problem);
    return Pose<D>{Vec<D>(matrix[D]), rotation_of(map)};
}

}  // namespace

Result<Pose2> pose_from(const glm::mat3& matrix) {
    detail::enter_library();
    return pose_of<2>(matrix);
}
Result<Pose3> pose_from(const glm::mat4& matrix) {
    detail::enter_library();
    return pose_of<3>(matrix);
}

}  // namespace abut
