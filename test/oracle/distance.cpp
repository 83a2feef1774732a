#include "distance.hpp"

#include <cmath>

namespace abut::oracle {

using namespace detail;

namespace {

/// The closest points found so far.
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

/// The closest points of the lines of two segments: their parameters are s and t over `denominator`.
struct LineParameters {
    double s, t, denominator;
    double error_bound;  ///< of s and t
};
LineParameters line_parameters(const DVec<2>& u, const DVec<2>& v, const DVec<2>& w) {
    const double n = cross(u, v);
    return {cross(w, v) * n, cross(w, u) * n, n * n, 1e-14 * length(w) * (length(u) + length(v)) * std::abs(n)};
}
LineParameters line_parameters(const DVec<3>& u, const DVec<3>& v, const DVec<3>& w) {
    const DVec<3> n = cross(u, v);
    return {dot(cross(w, v), n), dot(cross(w, u), n), dot(n, n),
            1e-14 * length(w) * (length(u) + length(v)) * length(n)};
}

/// Offers the closest points of two lines if both are inside of their segments. The parameters of nearly parallel lines
/// are mostly rounding, so each point is projected onto the other segment.
template <int D>
void offer_edge_pair(Nearest<D>& nearest, const DVec<D>& a, const DVec<D>& b, const DVec<D>& c, const DVec<D>& d) {
    const LineParameters at = line_parameters(b - a, d - c, c - a);
    if (!(at.denominator > 0)) return;
    if (std::min(at.s, at.t) < -at.error_bound || std::max(at.s, at.t) > at.denominator + at.error_bound) return;
    const DVec<D> there = nearest_on_segment(a + (b - a) * std::clamp(at.s / at.denominator, 0.0, 1.0), c, d);
    nearest.offer(nearest_on_segment(there, a, b), there);
}

template <int D>
Nearest<D> nearest_features(const LocalPolytope<D>& a, const LocalPolytope<D>& b) {
    Nearest<D> nearest;
    for (const DVec<D>& p : a.corners)
        for (const DVec<D>& q : b.corners) nearest.offer(p, q);
    for (const DVec<D>& p : a.corners)
        for (const auto& [k, l] : b.edges) nearest.offer(p, nearest_on_segment(p, b.corners[k], b.corners[l]));
    for (const DVec<D>& p : b.corners)
        for (const auto& [i, j] : a.edges) nearest.offer(nearest_on_segment(p, a.corners[i], a.corners[j]), p);
    for (const auto& [i, j] : a.edges)
        for (const auto& [k, l] : b.edges)
            offer_edge_pair(nearest, a.corners[i], a.corners[j], b.corners[k], b.corners[l]);
    if constexpr (D == 3) {
        DVec<3> on;
        for (const auto& [i, j, k] : a.triangles)
            for (const DVec<3>& p : b.corners)
                if (project_onto_triangle(p, a.corners[i], a.corners[j], a.corners[k], on)) nearest.offer(on, p);
        for (const auto& [i, j, k] : b.triangles)
            for (const DVec<3>& p : a.corners)
                if (project_onto_triangle(p, b.corners[i], b.corners[j], b.corners[k], on)) nearest.offer(p, on);
    }
    return nearest;
}

/// The least extent of A - B over the axes offered, along either sign of each.
template <int D>
struct MinExtentSearch {
    const LocalPolytope<D>&a, &b;
    double extent = std::numeric_limits<double>::infinity();
    DVec<D> normal{0.0};

    /// n has length 1, or is zero and then ignored.
    void offer(const DVec<D>& n) {
        if (!(length_squared(n) > 0.5)) return;
        for (const DVec<D>& direction : {n, -n}) {
            const double now = a.max_along(direction) - b.min_along(direction);
            if (now >= extent) continue;
            extent = now;
            normal = direction;
        }
    }
};

/// The unit normal of two directions, perpendicular to both to the last digits even if they are nearly parallel. Zero
/// if they are parallel.
DVec<3> common_normal(const DVec<3>& e, const DVec<3>& f) {
    DVec<3> n = normalized(cross(e, f), DVec<3>(0.0));
    for (const DVec<3>& edge : {e, f}) n -= edge * (dot(edge, n) / dot(edge, edge));
    return normalized(n, DVec<3>(0.0));
}

/// Whether all corners are on one side of the plane through `in_plane` with the normal n, to within `error_bound`.
bool on_one_side(const std::vector<DVec<3>>& corners, const DVec<3>& n, const DVec<3>& in_plane, double error_bound) {
    bool above = false, below = false;
    for (const DVec<3>& p : corners) {
        const double height = dot(n, p - in_plane);
        above = above || height > error_bound;
        below = below || height < -error_bound;
        if (above && below) return false;
    }
    return true;
}

/// Offers all face normals of the Minkowski difference A - B, and a few more. Two edges span a face only if A and B
/// each lie on one side of the plane along both. The least extent is right to about 1e-8 of the largest coordinate:
/// nearly parallel or tiny edges turn an axis far, but change the extent as little.
void offer_face_normals(MinExtentSearch<3>& search) {
    double reach = 0;
    for (const LocalPolytope<3>* both : {&search.a, &search.b}) {
        const auto& at = both->corners;
        for (const DVec<3>& p : at) reach = std::max(reach, largest(p));
        for (const auto& [i, j, k] : both->triangles) search.offer(common_normal(at[j] - at[i], at[k] - at[i]));
    }
    const auto &at_a = search.a.corners, &at_b = search.b.corners;
    // One edge may stand for several parallel ones. Then only its direction has a meaning, not its place.
    const bool own_a = search.a.edge_directions.size() == search.a.edges.size();
    const bool own_b = search.b.edge_directions.size() == search.b.edges.size();
    for (const auto& [i, j] : search.a.edge_directions)
        for (const auto& [k, l] : search.b.edge_directions) {
            const DVec<3> e = at_a[j] - at_a[i], f = at_b[l] - at_b[k];
            const double norm = length(cross(e, f));
            if (!(norm > 0)) continue;
            const double error_bound = 8e-15 * reach * (1 + reach * (length(e) + length(f)) / norm);
            const DVec<3> n = common_normal(e, f);
            if (own_a && !on_one_side(at_a, n, at_a[i], error_bound)) continue;
            if (own_b && !on_one_side(at_b, n, at_b[k], error_bound)) continue;
            search.offer(n);
        }
}
void offer_face_normals(MinExtentSearch<2>& search) {
    for (const LocalPolytope<2>* both : {&search.a, &search.b})
        for (const auto& [i, j] : both->edge_directions) {
            const DVec<2> e = both->corners[j] - both->corners[i];
            search.offer(normalized(DVec<2>(-e.y, e.x), DVec<2>(0.0)));
        }
}

}  // namespace

template <int D>
double gap_along(const Polytope<D>& a, const Polytope<D>& b, const DVec<D>& n) {
    const DVec<D> origin = middle(a);
    return LocalPolytope<D>(b, origin).min_along(n) - LocalPolytope<D>(a, origin).max_along(n);
}

template <int D>
Truth<D> truth(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic) {
    const DVec<D> origin = middle(a);
    const LocalPolytope<D> at_a(a, origin), at_b(b, origin);
    MinExtentSearch<D> search{at_a, at_b};
    offer_face_normals(search);
    // The bound of some twenty roundings. The errors of the unit vectors only move the axis.
    const double error_bound = 1e-14 * largest_coordinate(a, b);

    Truth<D> result;
    result.overlap = search.extent < std::numeric_limits<double>::infinity() && search.extent > error_bound;
    if (result.overlap) {
        result.distance = -search.extent;
        result.normal = search.normal;
    } else {
        const Nearest<D> nearest = nearest_features(at_a, at_b);
        result.distance = std::sqrt(nearest.distance_squared);
        const DVec<D> some = length_squared(search.normal) > 0 ? search.normal : axis<D>(0);
        result.normal = normalized(nearest.on_b - nearest.on_a, some);
        // If the shapes nearly touch, the direction between the points is rounding, and the best axis is more accurate.
        const double proved = at_b.min_along(result.normal) - at_a.max_along(result.normal);
        result.duality_gap = result.distance - std::max({proved, -search.extent, 0.0});
        if (result.distance <= error_bound && arithmetic == Arithmetic::exact) {
            const MinExtent<D> exact = min_extent(a, b, arithmetic);
            result.overlap = exact.overlap;
            result.rational = exact.rational;
        }
    }
    result.distance -= a.radius + b.radius;
    if (a.radius + b.radius > 0) result.overlap = result.distance <= 0;
    return result;
}

template double gap_along(const Polytope<2>&, const Polytope<2>&, const DVec<2>&);
template Truth<2> truth(const Polytope<2>&, const Polytope<2>&, Arithmetic);
template double gap_along(const Polytope<3>&, const Polytope<3>&, const DVec<3>&);
template Truth<3> truth(const Polytope<3>&, const Polytope<3>&, Arithmetic);

}  // namespace abut::oracle
