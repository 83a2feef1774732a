#include <abut/bake/fit.hpp>
#include <abut/bake/parts/fit_candidates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/ext/quaternion_common.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_geometric.hpp>

namespace abut {

using namespace detail;

namespace {

/// The largest distance of a corner of the part outside the shape, and of a point of the shape outside the part.
struct Excess {
    double of_part = 0, of_shape = 0;
};

/// The distance from a convex body is a convex function: on a capsule it is largest at the ends.
Excess excess(const Polyhedron& part, const Capsule<3>& capsule) {
    const double radius = static_cast<double>(capsule.radius);
    Excess result;
    for (const Vec3& corner : part.points())
        result.of_part = std::max(result.of_part, distance_to_axis(capsule, DVec<3>(corner)) - radius);
    for (const Vec3& end : {capsule.a, capsule.b})
        result.of_shape = std::max(result.of_shape, radius - depth_in(part, DVec<3>(end)));
    return result;
}

Excess excess(const Polyhedron& part, const Box<3>& box) {
    const glm::dquat turn = normalized(glm::dquat(box.rotation));
    const DVec<3> half(box.half), center(box.center);
    Excess result;
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
struct RatedShape {
    RatedShape(const Polyhedron& part, const S& candidate) : shape(candidate) {
        const Excess beyond = excess(part, shape);
        error = std::max(beyond.of_part, beyond.of_shape);
        excess_of_part = beyond.of_part;
    }

    S shape;
    double error = 0;
    double excess_of_part = 0;  ///< largest distance of a corner of the part outside the shape
};

/// The middle one of the box's half edges.
double breadth_of(const Box<3>& box) {
    const Vec3& half = box.half;
    return static_cast<double>(std::max(std::min(half.x, half.y), std::min(std::max(half.x, half.y), half.z)));
}

using RatedRound = std::optional<RatedShape<Capsule<3>>>;

/// Evaluates a candidate, grown first if it has to contain the part.
RatedRound rated(const Polyhedron& part, const std::optional<Capsule<3>>& capsule, bool hold) {
    if (!capsule) return std::nullopt;
    RatedShape<Capsule<3>> result(part, *capsule);
    if (!hold) return result;
    Capsule<3> larger = *capsule;
    larger.radius = std::nextafter(static_cast<float>(static_cast<double>(larger.radius) + result.excess_of_part),
                                   std::numeric_limits<float>::infinity());
    return RatedShape<Capsule<3>>(part, larger);
}

RatedRound best_capsule(const Polyhedron& part, const Axes& axes, bool hold) {
    RatedRound best;
    for (const DVec<3>& axis : axes) {
        const RatedRound next = rated(part, fit_capsule(part, axis), hold);
        if (next && (!best || next->error < best->error)) best = next;
    }
    return best;
}

}  // namespace

std::optional<Fit> fit(const Polyhedron& part, const FitOptions& options) {
    if (part.rank() < 2) return std::nullopt;
    const bool is_solid = part.rank() == 3;
    const Axes principal = principal_axes(part);
    const RatedShape<Box<3>> box(part, oriented_box_around(part, principal));
    const double size = part.ball().radius, tolerance = options.tolerance * breadth_of(box.shape);
    const RatedRound capsule = is_solid ? best_capsule(part, principal, options.hold) : std::nullopt;
    const RatedRound ball = is_solid ? rated(part, fit_ball(part), options.hold) : std::nullopt;

    double best_error = box.error;
    for (const RatedRound& round : {capsule, ball})
        if (round) best_error = std::min(best_error, round->error);
    const double max_error = std::min(best_error + 0.1 * tolerance, tolerance);
    const auto as_fit = [&](const auto& candidate, const auto& shape) {
        return Fit{shape, candidate.error, candidate.excess_of_part <= 1e-6 * size};
    };
    if (ball && ball->error <= max_error) return as_fit(*ball, Ball<3>{ball->shape.a, ball->shape.radius});
    if (capsule && capsule->error <= max_error) return as_fit(*capsule, capsule->shape);
    if (box.error <= max_error) return as_fit(box, box.shape);
    return std::nullopt;
}

}  // namespace abut
