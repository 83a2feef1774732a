#include <abut/bake/parts/fit_candidates.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/closest.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {
namespace {

/// The core segment of a capsule; its ends are equal for a ball.
struct CoreSegment {
    DVec<3> a{0.0}, b{0.0};
};

/// The parameter of the segment's closest point: 0 at a, 1 at b.
double nearest_parameter(const CoreSegment& core, const DVec<3>& point) {
    const DVec<3> along = core.b - core.a;
    const double square = length_squared(along);
    return square > 0 ? std::clamp(dot(point - core.a, along) / square, 0.0, 1.0) : 0.0;
}

struct Face {
    DVec<3> normal{0.0};
    double depth = std::numeric_limits<double>::infinity();
};

/// The face with the smallest depth of a point; the point is above it if the depth is negative.
Face nearest_face(const Polyhedron& part, const DVec<3>& point) {
    const Facets& facets = part.facets();
    Face result;
    for (std::size_t i = 0; i < facets.normals.size(); ++i) {
        const DVec<3> normal(facets.normals[i]);
        const double depth = part.offsets()[i] - dot(normal, point);
        if (depth < result.depth) result = {normal, depth};
    }
    return result;
}

/// The shell between the circumscribed radius (the farthest corner of the part) and the inscribed radius (the smallest
/// depth of the core's ends). Half its width is the error of the best radius.
struct ShellWidth {
    double outer = 0, inner = 0;
    DVec<3> descent_a{0.0}, descent_b{0.0};  // descent directions of the ends

    double width() const { return outer - inner; }
};

ShellWidth shell_width_at(const Polyhedron& part, const CoreSegment& core) {
    ShellWidth result;
    for (const Vec3& corner : part.points()) {
        const double t = nearest_parameter(core, DVec<3>(corner));
        const DVec<3> out = DVec<3>(corner) - (core.a * (1 - t) + core.b * t);
        const double distance = length(out);
        if (distance <= result.outer) continue;
        result.outer = distance;
        result.descent_a = out / distance * (1 - t);
        result.descent_b = out / distance * t;
    }
    const Face at_a = nearest_face(part, core.a), at_b = nearest_face(part, core.b);
    const bool a_is_nearer = at_a.depth <= at_b.depth;
    result.inner = a_is_nearer ? at_a.depth : at_b.depth;
    (a_is_nearer ? result.descent_a : result.descent_b) -= a_is_nearer ? at_a.normal : at_b.normal;
    return result;
}

/// Subgradient descent with decreasing steps. Returns the best iterate.
std::optional<Capsule<3>> descend(const Polyhedron& part, CoreSegment core, bool is_ball) {
    constexpr int steps = 300;
    constexpr double shorter = 0.97, first = 0.2;
    CoreSegment best = core;
    ShellWidth best_shell = shell_width_at(part, core), shell = best_shell;
    double step = first * part.ball().radius;
    for (int i = 0; i < steps; ++i, step *= shorter) {
        if (is_ball) shell.descent_a = shell.descent_b = shell.descent_a + shell.descent_b;
        const double size = square_root(length_squared(shell.descent_a) + length_squared(shell.descent_b));
        if (!(size > 0)) break;
        core.a += shell.descent_a * (step / size);
        core.b += shell.descent_b * (step / size);
        shell = shell_width_at(part, core);
        if (shell.width() >= best_shell.width()) continue;
        best = core;
        best_shell = shell;
    }
    if (!(best_shell.inner > 0)) return std::nullopt;
    return Capsule<3>{to_float(best.a), to_float(best.b),
                      static_cast<float>((best_shell.outer + best_shell.inner) * 0.5)};
}

}  // namespace

double depth_in(const Polyhedron& part, const DVec<3>& point) {
    // The faces of a flat part don't bound it within its plane.
    const double depth = part.rank() < 3 ? -1 : nearest_face(part, point).depth;
    return depth >= 0 ? depth : -std::max(0.0, static_cast<double>(closest(part, to_float(point)).distance));
}

double distance_to_axis(const Capsule<3>& capsule, const DVec<3>& point) {
    const CoreSegment core{DVec<3>(capsule.a), DVec<3>(capsule.b)};
    const double t = nearest_parameter(core, point);
    return length(point - (core.a * (1 - t) + core.b * t));
}

std::optional<Capsule<3>> fit_ball(const Polyhedron& part) {
    const DVec<3> middle(part.centroid());
    return descend(part, {middle, middle}, true);
}

std::optional<Capsule<3>> fit_capsule(const Polyhedron& part, const DVec<3>& axis) {
    const DVec<3> middle(part.centroid());
    double low = 0, high = 0, radius = 0;
    for (const Vec3& corner : part.points()) {
        const DVec<3> to = DVec<3>(corner) - middle;
        const double along = dot(axis, to);
        low = std::min(low, along);
        high = std::max(high, along);
        radius = std::max(radius, length(to - axis * along));
    }
    const double center = (low + high) * 0.5, half = std::max((high - low) * 0.5 - radius, 0.0);
    return descend(part, {middle + axis * (center - half), middle + axis * (center + half)}, false);
}

}  // namespace abut::detail
