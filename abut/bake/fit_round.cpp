#include <abut/bake/fit_candidates.hpp>
#include <abut/query/closest.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {
namespace {

/// The ends of a segment; of a point both are the same.
struct Ends {
    DVec<3> a{0.0}, b{0.0};
};

/// The place on the segment nearest to a point, from 0 at a to 1 at b.
double nearest_on(const Ends& ends, const DVec<3>& point) {
    const DVec<3> way = ends.b - ends.a;
    const double square = length_squared(way);
    return square > 0 ? std::clamp(dot(point - ends.a, way) / square, 0.0, 1.0) : 0.0;
}

struct Face {
    DVec<3> normal{0.0};
    double depth = std::numeric_limits<double>::infinity();
};

/// The face that a point is least deep under; above it where the depth is below 0.
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

/// What a ball that rolls along the segment leaves between itself and the part: the farthest corner of the part from
/// it, and the least depth of its ends. Half of the difference is the error of the best radius.
struct Gap {
    double outer = 0, inner = 0;
    DVec<3> down_a{0.0}, down_b{0.0};  // the way to move each end for it to get smaller

    double width() const { return outer - inner; }
};

Gap gap_at(const Polyhedron& part, const Ends& ends) {
    Gap result;
    for (const Vec3& corner : part.points()) {
        const double t = nearest_on(ends, DVec<3>(corner));
        const DVec<3> out = DVec<3>(corner) - (ends.a * (1 - t) + ends.b * t);
        const double distance = length(out);
        if (distance <= result.outer) continue;
        result.outer = distance;
        result.down_a = out / distance * (1 - t);
        result.down_b = out / distance * t;
    }
    const Face at_a = nearest_face(part, ends.a), at_b = nearest_face(part, ends.b);
    const bool a_is_nearer = at_a.depth <= at_b.depth;
    result.inner = a_is_nearer ? at_a.depth : at_b.depth;
    (a_is_nearer ? result.down_a : result.down_b) -= a_is_nearer ? at_a.normal : at_b.normal;
    return result;
}

/// Subgradient descent with steps that get shorter; the best place on the way.
std::optional<Capsule<3>> descended(const Polyhedron& part, Ends ends, bool is_ball) {
    constexpr int steps = 300;
    constexpr double shorter = 0.97, first = 0.2;
    Ends best = ends;
    Gap best_gap = gap_at(part, ends), gap = best_gap;
    double step = first * part.ball().radius;
    for (int i = 0; i < steps; ++i, step *= shorter) {
        if (is_ball) gap.down_a = gap.down_b = gap.down_a + gap.down_b;
        const double size = std::sqrt(length_squared(gap.down_a) + length_squared(gap.down_b));
        if (!(size > 0)) break;
        ends.a += gap.down_a * (step / size);
        ends.b += gap.down_b * (step / size);
        gap = gap_at(part, ends);
        if (gap.width() >= best_gap.width()) continue;
        best = ends;
        best_gap = gap;
    }
    if (!(best_gap.inner > 0)) return std::nullopt;
    return Capsule<3>{to_float(best.a), to_float(best.b), static_cast<float>((best_gap.outer + best_gap.inner) * 0.5)};
}

}  // namespace

double depth_in(const Polyhedron& part, const DVec<3>& point) {
    // The faces of a flat part don't bound it within its plane.
    const double depth = part.rank() < 3 ? -1 : nearest_face(part, point).depth;
    return depth >= 0 ? depth : -std::max(0.0, static_cast<double>(closest(part, to_float(point)).distance));
}

double distance_to_axis(const Capsule<3>& capsule, const DVec<3>& point) {
    const Ends ends{DVec<3>(capsule.a), DVec<3>(capsule.b)};
    const double t = nearest_on(ends, point);
    return length(point - (ends.a * (1 - t) + ends.b * t));
}

std::optional<Capsule<3>> ball_near(const Polyhedron& part) {
    const DVec<3> middle(part.centroid());
    return descended(part, {middle, middle}, true);
}

std::optional<Capsule<3>> capsule_near(const Polyhedron& part, const DVec<3>& axis) {
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
    return descended(part, {middle + axis * (center - half), middle + axis * (center + half)}, false);
}

}  // namespace abut
