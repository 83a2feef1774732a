#pragma once

// The true signed distance of two polytopes. A gap by trying all pairs of features, with a proof: the plane between
// them. An overlap by trying all axes.

#include "axes.hpp"

namespace abut::oracle {

/// The nearest points found so far.
template <int D>
struct Nearest {
    double distance_squared = std::numeric_limits<double>::infinity();
    DVec<D> on_a{0.0}, on_b{0.0};

    void offer(const DVec<D>& a, const DVec<D>& b) {
        const double now = length_squared(b - a);
        if (now >= distance_squared) return;
        distance_squared = now;
        on_a = a;
        on_b = b;
    }
};

template <int D>
DVec<D> nearest_on_segment(const DVec<D>& p, const DVec<D>& from, const DVec<D>& to) {
    const DVec<D> along = to - from;
    const double whole = dot(along, along);
    return whole > 0 ? from + along * std::clamp(dot(p - from, along) / whole, 0.0, 1.0) : from;
}

/// The lines' nearest points where both are inside, and each end against the other segment.
template <int D>
void offer_segments(Nearest<D>& nearest, const DVec<D>& a, const DVec<D>& b, const DVec<D>& c, const DVec<D>& d) {
    nearest.offer(a, nearest_on_segment(a, c, d));
    nearest.offer(b, nearest_on_segment(b, c, d));
    nearest.offer(nearest_on_segment(c, a, b), c);
    nearest.offer(nearest_on_segment(d, a, b), d);
    const DVec<D> u = b - a, v = d - c, w = a - c;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double whole = uu * vv - uv * uv;
    if (!(whole > 0)) return;
    const double s = (uv * vw - vv * uw) / whole, t = (uu * vw - uv * uw) / whole;
    if (s > 0 && s < 1 && t > 0 && t < 1) nearest.offer(a + u * s, c + v * t);
}

/// Where p projects into the triangle; what projects outside is nearer to an edge.
inline bool project(const DVec<3>& p, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, DVec<3>& on) {
    const DVec<3> normal = normalized(cross(b - a, c - a), DVec<3>(0.0));
    const double u = dot(cross(b - a, p - a), normal), v = dot(cross(c - b, p - b), normal),
                 w = dot(cross(a - c, p - c), normal);
    on = p - normal * dot(p - a, normal);
    // With some slack, so that nothing falls between the two triangles of a square.
    return u + v + w > 0 && std::min({u, v, w}) >= -1e-12 * (u + v + w);
}

template <int D>
struct Truth {
    bool overlap = false;  ///< with the radii; exact for polytopes without
    double distance = 0;   ///< signed, with the radii
    DVec<D> normal{0.0};   ///< of length 1, from A to B
    double unproved = 0;   ///< by how much the gap found is above the gap proved by a plane; rounding, or a bug here
    bool rational = false;
};

template <int D>
Nearest<D> nearest_features(const Polytope<D>& a, const Polytope<D>& b) {
    const DVec<D> origin = middle(a);
    const std::vector<DVec<D>> at_a = corners_seen_from(a, origin), at_b = corners_seen_from(b, origin);
    const auto edges = [](const Polytope<D>& polytope) {
        return polytope.edges.empty() ? std::vector<std::array<std::uint32_t, 2>>{{0, 0}} : polytope.edges;
    };
    Nearest<D> nearest;
    const auto edges_b = edges(b);
    for (const auto& [i, j] : edges(a))
        for (const auto& [k, l] : edges_b) offer_segments(nearest, at_a[i], at_a[j], at_b[k], at_b[l]);
    if constexpr (D == 3) {
        DVec<3> on;
        for (const DVec<3>& p : at_b)
            for (const auto& [i, j, k] : a.triangles)
                if (project(p, at_a[i], at_a[j], at_a[k], on)) nearest.offer(on, p);
        for (const DVec<3>& p : at_a)
            for (const auto& [i, j, k] : b.triangles)
                if (project(p, at_b[i], at_b[j], at_b[k], on)) nearest.offer(p, on);
    }
    return nearest;
}

/// The gap between A and B along n, without their radii; below zero where they overlap along it.
template <int D>
double gap_along(const Polytope<D>& a, const Polytope<D>& b, const DVec<D>& n) {
    const DVec<D> origin = middle(a);
    double high_a = -std::numeric_limits<double>::infinity(), low_b = -high_a;
    for (const DVec<D>& p : corners_seen_from(a, origin)) high_a = std::max(high_a, dot(n, p));
    for (const DVec<D>& p : corners_seen_from(b, origin)) low_b = std::min(low_b, dot(n, p));
    return low_b - high_a;
}

template <int D>
Truth<D> truth(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic = Arithmetic::exact) {
    const LeastExtent<D> least = least_extent(a, b, arithmetic);
    Truth<D> result;
    result.rational = least.rational;
    if (least.overlap) {
        result.distance = -std::max(least.extent, 0.0);
        result.normal = least.normal;
    } else {
        const Nearest<D> nearest = nearest_features(a, b);
        result.distance = std::sqrt(nearest.distance_squared);
        result.normal = normalized(nearest.on_b - nearest.on_a, least.normal);
        // Of what nearly touches, the direction between two points is rounding, and the best axis knows better.
        result.unproved = result.distance - std::max(gap_along(a, b, result.normal), -least.extent);
    }
    result.distance -= a.radius + b.radius;
    result.overlap = a.radius + b.radius > 0 ? result.distance <= 0 : least.overlap;
    return result;
}

}  // namespace abut::oracle
