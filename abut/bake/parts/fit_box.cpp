#include <abut/bake/parts/fit_candidates.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>

namespace abut::detail {
namespace {

using Symmetric = std::array<std::array<double, 3>, 3>;

/// Second moments of the faces about their common centroid.
Symmetric moments_of(const Polyhedron& part) {
    const Facets& facets = part.facets();
    Symmetric result{};
    const DVec<3> middle(part.centroid());
    for (std::size_t face = 0; face < facets.normals.size(); ++face) {
        const std::span<const std::uint32_t> loop = facets.loop(face);
        const DVec<3> a = DVec<3>(part.points()[loop[0]]) - middle;
        for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
            const DVec<3> b = DVec<3>(part.points()[loop[i]]) - middle;
            const DVec<3> c = DVec<3>(part.points()[loop[i + 1]]) - middle, sum = a + b + c;
            const double area = length(cross(b - a, c - a));
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 3; ++column)
                    result[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] +=
                        area * (a[row] * a[column] + b[row] * b[column] + c[row] * c[column] + sum[row] * sum[column]);
        }
    }
    return result;
}

/// Jacobi's method: rotates about one axis after the other until the matrix is diagonal.
Axes eigenvectors(Symmetric m) {
    constexpr int max_sweeps = 24;
    Axes vectors{axis<3>(0), axis<3>(1), axis<3>(2)};
    for (int sweep = 0; sweep < max_sweeps; ++sweep)
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0) continue;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + square_root(theta * theta + 1));
                const double c = 1 / square_root(t * t + 1), s = t * c;
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = m[k][p], b = m[k][q];
                    m[k][p] = c * a - s * b;
                    m[k][q] = s * a + c * b;
                }
                for (std::size_t k = 0; k < 3; ++k) {
                    const double a = m[p][k], b = m[q][k];
                    m[p][k] = c * a - s * b;
                    m[q][k] = s * a + c * b;
                }
                const DVec<3> a = vectors[p], b = vectors[q];
                vectors[p] = a * c - b * s;
                vectors[q] = a * s + b * c;
            }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return m[a][a] > m[b][b]; });
    const DVec<3> first = normalized(vectors[order[0]]), third = normalized(cross(first, vectors[order[1]]));
    return {first, cross(third, first), third};
}

/// Bounds along given axes, and their volume.
struct OrientedBounds {
    Axes axes;
    DVec<3> low, high;
    double volume = 0;
};

OrientedBounds bounds_along(const Polyhedron& part, const Axes& axes) {
    OrientedBounds result{axes, DVec<3>(std::numeric_limits<double>::infinity()),
                          DVec<3>(-std::numeric_limits<double>::infinity()), 1};
    for (const Vec3& point : part.points())
        for (int i = 0; i < 3; ++i) {
            const double along = dot(axes[static_cast<std::size_t>(i)], DVec<3>(point));
            result.low[i] = std::min(result.low[i], along);
            result.high[i] = std::max(result.high[i], along);
        }
    // A zero extent counts as a millionth of the size, so that flat parts are compared by their area.
    const DVec<3> size = result.high - result.low;
    const double best_error = 1e-6 * part.ball().radius;
    for (int i = 0; i < 3; ++i) result.volume *= std::max(size[i], best_error);
    return result;
}

Axes rotated(const Axes& axes, int around, double half_tangent) {
    glm::dquat turn(1, 0, 0, 0);
    const DVec<3>& axis = axes[static_cast<std::size_t>(around)];
    turn.x = axis.x * half_tangent;
    turn.y = axis.y * half_tangent;
    turn.z = axis.z * half_tangent;
    turn = normalized(turn);
    return {turn * axes[0], turn * axes[1], turn * axes[2]};
}

/// Minimizes the volume by rotations about each axis in turn, with decreasing steps.
OrientedBounds minimised(const Polyhedron& part, OrientedBounds best) {
    constexpr double first_step = 0.05, last_step = 1e-5;
    constexpr int max_turns = 8;
    for (double step = first_step; step > last_step; step *= 0.5)
        for (int around = 0; around < 3; ++around)
            for (const double angle : {step, -step})
                for (int i = 0; i < max_turns; ++i) {
                    const OrientedBounds next = bounds_along(part, rotated(best.axes, around, angle));
                    if (!(next.volume < best.volume * (1 - 1e-9))) break;
                    best = next;
                }
    return best;
}

Box<3> box_of(const Polyhedron& part, const Axes& axes) {
    glm::dmat3 turn(1.0);
    for (std::size_t i = 0; i < 3; ++i) turn[static_cast<glm::length_t>(i)] = axes[i];
    Box<3> box;
    box.rotation = glm::normalize(glm::quat(glm::quat_cast(turn)));
    // The bounds are tight along the axes as rounded to float.
    const glm::dquat rounded = normalized(glm::dquat(box.rotation));
    const OrientedBounds frame = bounds_along(part, {rounded * axis<3>(0), rounded * axis<3>(1), rounded * axis<3>(2)});
    box.center = to_float(rounded * ((frame.low + frame.high) * 0.5));
    const DVec<3> center(box.center);
    for (int i = 0; i < 3; ++i) {
        const double middle = dot(frame.axes[static_cast<std::size_t>(i)], center);
        box.half[i] = static_cast<float>(std::max({frame.high[i] - middle, middle - frame.low[i], 0.0}));
    }
    return box;
}

}  // namespace

glm::dquat normalized(const glm::dquat& q) {
    const double norm = square_root((q.w * q.w + q.x * q.x) + (q.y * q.y + q.z * q.z));
    if (norm == 0) return {1, 0, 0, 0};
    const double inverse = 1 / norm;
    return {q.w * inverse, q.x * inverse, q.y * inverse, q.z * inverse};
}

Axes principal_axes(const Polyhedron& part) {
    return eigenvectors(moments_of(part));
}

Box<3> oriented_box_around(const Polyhedron& part, const Axes& principal) {
    return box_of(part, minimised(part, bounds_along(part, principal)).axes);
}

}  // namespace abut::detail
