#include <abut/bake/fit.hpp>
#include <abut/bake/fit_candidates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/ext/quaternion_common.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_geometric.hpp>

namespace abut {
namespace {

/// How far corners of the part are outside at most, and how far the shape is outside of the part.
struct Reach {
    double of_part = 0, of_shape = 0;
};

/// A convex function, such as the distance to a convex body, is largest at the ends of a capsule.
Reach reach(const Polyhedron& part, const Capsule<3>& capsule) {
    const double radius = static_cast<double>(capsule.radius);
    Reach result;
    for (const Vec3& corner : part.points())
        result.of_part = std::max(result.of_part, distance_to_axis(capsule, DVec<3>(corner)) - radius);
    for (const Vec3& end : {capsule.a, capsule.b})
        result.of_shape = std::max(result.of_shape, radius - depth_in(part, DVec<3>(end)));
    return result;
}

Reach reach(const Polyhedron& part, const Box<3>& box) {
    const glm::dquat turn = glm::normalize(glm::dquat(box.rotation));
    const DVec<3> half(box.half), center(box.center);
    Reach result;
    for (const Vec3& corner : part.points()) {
        const DVec<3> at = glm::conjugate(turn) * (DVec<3>(corner) - center);
        DVec<3> beyond(0.0);
        for (int i = 0; i < 3; ++i) beyond[i] = std::max(0.0, std::abs(at[i]) - half[i]);
        result.of_part = std::max(result.of_part, length(beyond));
    }
    for (int i = 0; i < 8; ++i) {
        const DVec<3> corner((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                             (i & 4) != 0 ? half.z : -half.z);
        result.of_shape = std::max(result.of_shape, -depth_in(part, center + turn * corner));
    }
    return result;
}

template <class S>
struct Candidate {
    Candidate(const Polyhedron& part, const S& candidate) : shape(candidate) {
        const Reach far = reach(part, shape);
        error = std::max(far.of_part, far.of_shape);
        outside = far.of_part;
    }

    S shape;
    double error = 0;
    double outside = 0;  ///< the most that the part is
};

/// The middle one of its half edges.
double breadth_of(const Box<3>& box) {
    const Vec3& half = box.half;
    return static_cast<double>(std::max(std::min(half.x, half.y), std::min(std::max(half.x, half.y), half.z)));
}

using Round = std::optional<Candidate<Capsule<3>>>;

/// How good a candidate is, once it is as large as it has to be.
Round rated(const Polyhedron& part, const std::optional<Capsule<3>>& capsule, bool hold) {
    if (!capsule) return std::nullopt;
    Candidate<Capsule<3>> result(part, *capsule);
    if (!hold) return result;
    Capsule<3> larger = *capsule;
    larger.radius = std::nextafter(static_cast<float>(static_cast<double>(larger.radius) + result.outside),
                                   std::numeric_limits<float>::infinity());
    return Candidate<Capsule<3>>(part, larger);
}

Round best_capsule(const Polyhedron& part, const Axes& axes, bool hold) {
    Round best;
    for (const DVec<3>& axis : axes) {
        const Round next = rated(part, capsule_near(part, axis), hold);
        if (next && (!best || next->error < best->error)) best = next;
    }
    return best;
}

}  // namespace

std::optional<Fit> fit(const Polyhedron& part, const FitOptions& options) {
    if (part.rank() < 2) return std::nullopt;
    const bool is_solid = part.rank() == 3;
    const Axes principal = principal_axes(part);
    const Candidate<Box<3>> box(part, box_about(part, principal));
    const double size = part.ball().radius, tolerance = options.tolerance * breadth_of(box.shape);
    const Round capsule = is_solid ? best_capsule(part, principal, options.hold) : std::nullopt;
    const Round ball = is_solid ? rated(part, ball_near(part), options.hold) : std::nullopt;

    double least = box.error;
    for (const Round& round : {capsule, ball})
        if (round) least = std::min(least, round->error);
    const double enough = std::min(least + 0.1 * tolerance, tolerance);
    const auto as_fit = [&](const auto& candidate, const auto& shape) {
        return Fit{shape, candidate.error, candidate.outside <= 1e-6 * size};
    };
    if (ball && ball->error <= enough) return as_fit(*ball, Ball<3>{ball->shape.a, ball->shape.radius});
    if (capsule && capsule->error <= enough) return as_fit(*capsule, capsule->shape);
    if (box.error <= enough) return as_fit(box, box.shape);
    return std::nullopt;
}

}  // namespace abut
