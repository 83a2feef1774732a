#include <abut/bake/fit_candidates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/gtc/quaternion.hpp>

namespace abut {
namespace {

using Symmetric = std::array<std::array<double, 3>, 3>;

/// Second moments of the faces about the middle of all of them.
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

/// Jacobi's method: turns about one axis after the other until nothing is left beside the diagonal.
Axes eigenvectors(Symmetric m) {
    constexpr int most_sweeps = 24;
    Axes vectors{axis<3>(0), axis<3>(1), axis<3>(2)};
    for (int sweep = 0; sweep < most_sweeps; ++sweep)
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (m[p][q] == 0) continue;
                const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
                const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
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

/// The box with these axes, and how large it is.
struct Framed {
    Axes axes;
    DVec<3> low, high;
    double volume = 0;
};

Framed framed(const Polyhedron& part, const Axes& axes) {
    Framed result{axes, DVec<3>(std::numeric_limits<double>::infinity()),
                  DVec<3>(-std::numeric_limits<double>::infinity()), 1};
    for (const Vec3& point : part.points())
        for (int i = 0; i < 3; ++i) {
            const double along = dot(axes[static_cast<std::size_t>(i)], DVec<3>(point));
            result.low[i] = std::min(result.low[i], along);
            result.high[i] = std::max(result.high[i], along);
        }
    // Flat parts are compared by their area: what has no thickness counts as a millionth of the size.
    const DVec<3> size = result.high - result.low;
    const double least = 1e-6 * part.ball().radius;
    for (int i = 0; i < 3; ++i) result.volume *= std::max(size[i], least);
    return result;
}

Axes turned(const Axes& axes, int about, double half_tangent) {
    glm::dquat turn(1, 0, 0, 0);
    const DVec<3>& axis = axes[static_cast<std::size_t>(about)];
    turn.x = axis.x * half_tangent;
    turn.y = axis.y * half_tangent;
    turn.z = axis.z * half_tangent;
    turn = glm::normalize(turn);
    return {turn * axes[0], turn * axes[1], turn * axes[2]};
}

/// Turned a little about each axis as long as that makes it smaller, by less and less.
Framed shrunk(const Polyhedron& part, Framed best) {
    constexpr double first_step = 0.05, last_step = 1e-5;
    constexpr int most_turns = 8;
    for (double step = first_step; step > last_step; step *= 0.5)
        for (int about = 0; about < 3; ++about)
            for (const double way : {step, -step})
                for (int i = 0; i < most_turns; ++i) {
                    const Framed next = framed(part, turned(best.axes, about, way));
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
    // Tight along the axes as floats have them.
    const glm::dquat rounded = glm::normalize(glm::dquat(box.rotation));
    const Framed frame = framed(part, {rounded * axis<3>(0), rounded * axis<3>(1), rounded * axis<3>(2)});
    box.center = to_float(rounded * ((frame.low + frame.high) * 0.5));
    const DVec<3> center(box.center);
    for (int i = 0; i < 3; ++i) {
        const double middle = dot(frame.axes[static_cast<std::size_t>(i)], center);
        box.half[i] = static_cast<float>(std::max({frame.high[i] - middle, middle - frame.low[i], 0.0}));
    }
    return box;
}

}  // namespace

Axes principal_axes(const Polyhedron& part) {
    return eigenvectors(moments_of(part));
}

Box<3> box_about(const Polyhedron& part, const Axes& principal) {
    return box_of(part, shrunk(part, framed(part, principal)).axes);
}

}  // namespace abut
