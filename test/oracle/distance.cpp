#include "distance.hpp"

#include <cmath>

namespace abut::oracle {
namespace {

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

/// Where on their lines two segments are nearest, as parts of the square of cross(u, v).
struct Crossing {
    double s, t, whole;
    double doubt;  ///< of s and t
};
Crossing crossing(const DVec<2>& u, const DVec<2>& v, const DVec<2>& w) {
    const double n = cross(u, v);
    return {cross(w, v) * n, cross(w, u) * n, n * n, 1e-14 * length(w) * (length(u) + length(v)) * std::abs(n)};
}
Crossing crossing(const DVec<3>& u, const DVec<3>& v, const DVec<3>& w) {
    const DVec<3> n = cross(u, v);
    return {dot(cross(w, v), n), dot(cross(w, u), n), dot(n, n),
            1e-14 * length(w) * (length(u) + length(v)) * length(n)};
}

/// The lines' nearest points, where both are inside of their segments. Of lines that are nearly parallel the places are
/// mostly rounding; each is brought nearest to the other.
template <int D>
void offer_crossing(Nearest<D>& nearest, const DVec<D>& a, const DVec<D>& b, const DVec<D>& c, const DVec<D>& d) {
    const Crossing at = crossing(b - a, d - c, c - a);
    if (!(at.whole > 0)) return;
    if (std::min(at.s, at.t) < -at.doubt || std::max(at.s, at.t) > at.whole + at.doubt) return;
    const DVec<D> there = nearest_on_segment(a + (b - a) * std::clamp(at.s / at.whole, 0.0, 1.0), c, d);
    nearest.offer(nearest_on_segment(there, a, b), there);
}

template <int D>
Nearest<D> nearest_features(const Located<D>& a, const Located<D>& b) {
    Nearest<D> nearest;
    for (const DVec<D>& p : a.corners)
        for (const DVec<D>& q : b.corners) nearest.offer(p, q);
    for (const DVec<D>& p : a.corners)
        for (const auto& [k, l] : b.edges) nearest.offer(p, nearest_on_segment(p, b.corners[k], b.corners[l]));
    for (const DVec<D>& p : b.corners)
        for (const auto& [i, j] : a.edges) nearest.offer(nearest_on_segment(p, a.corners[i], a.corners[j]), p);
    for (const auto& [i, j] : a.edges)
        for (const auto& [k, l] : b.edges)
            offer_crossing(nearest, a.corners[i], a.corners[j], b.corners[k], b.corners[l]);
    if constexpr (D == 3) {
        DVec<3> on;
        for (const auto& [i, j, k] : a.triangles)
            for (const DVec<3>& p : b.corners)
                if (project(p, a.corners[i], a.corners[j], a.corners[k], on)) nearest.offer(on, p);
        for (const auto& [i, j, k] : b.triangles)
            for (const DVec<3>& p : a.corners)
                if (project(p, b.corners[i], b.corners[j], b.corners[k], on)) nearest.offer(p, on);
    }
    return nearest;
}

/// The least extent of A - B over the axes offered, along either sign of each.
template <int D>
struct LeastOver {
    const Located<D>&a, &b;
    double extent = std::numeric_limits<double>::infinity();
    DVec<D> normal{0.0};

    /// Of length 1, or zero: none.
    void offer(const DVec<D>& n) {
        if (!(length_squared(n) > 0.5)) return;
        for (const DVec<D>& way : {n, -n}) {
            const double now = a.most(way) - b.least(way);
            if (now >= extent) continue;
            extent = now;
            normal = way;
        }
    }
};

/// Of length 1, and at right angles to both to the last digits, however nearly parallel they are; zero where they are
/// parallel.
DVec<3> across_both(const DVec<3>& e, const DVec<3>& f) {
    DVec<3> n = normalized(cross(e, f), DVec<3>(0.0));
    for (const DVec<3>& edge : {e, f}) n -= edge * (dot(edge, n) / dot(edge, edge));
    return normalized(n, DVec<3>(0.0));
}

/// Whether no corner is beyond doubt above the others' plane while another is below it: the plane through `in_plane`
/// across n.
bool on_one_side(const std::vector<DVec<3>>& corners, const DVec<3>& n, const DVec<3>& in_plane, double doubt) {
    bool above = false, below = false;
    for (const DVec<3>& p : corners) {
        const double height = dot(n, p - in_plane);
        above = above || height > doubt;
        below = below || height < -doubt;
        if (above && below) return false;
    }
    return true;
}

/// All normals of the faces of A - B where it has any, and a few more. An edge of each spans a face only where A lies
/// on one side of the plane along both, and so does B. With axes as good as rounding lets them be, the least extent is
/// right to about 1e-8 of the largest coordinate: what is nearly parallel or tiny turns an axis far, but then matters
/// as little.
void offer_face_normals(LeastOver<3>& least) {
    double reach = 0;
    for (const Located<3>* both : {&least.a, &least.b}) {
        const auto& at = both->corners;
        for (const DVec<3>& p : at) reach = std::max(reach, largest(p));
        for (const auto& [i, j, k] : both->triangles) least.offer(across_both(at[j] - at[i], at[k] - at[i]));
    }
    const auto &at_a = least.a.corners, &at_b = least.b.corners;
    // One edge may stand for several parallel ones; then only its direction means something.
    const bool own_a = least.a.edge_directions.size() == least.a.edges.size();
    const bool own_b = least.b.edge_directions.size() == least.b.edges.size();
    for (const auto& [i, j] : least.a.edge_directions)
        for (const auto& [k, l] : least.b.edge_directions) {
            const DVec<3> e = at_a[j] - at_a[i], f = at_b[l] - at_b[k];
            const double norm = length(cross(e, f));
            if (!(norm > 0)) continue;
            const double doubt = 8e-15 * reach * (1 + reach * (length(e) + length(f)) / norm);
            const DVec<3> n = across_both(e, f);
            if (own_a && !on_one_side(at_a, n, at_a[i], doubt)) continue;
            if (own_b && !on_one_side(at_b, n, at_b[k], doubt)) continue;
            least.offer(n);
        }
}
void offer_face_normals(LeastOver<2>& least) {
    for (const Located<2>* both : {&least.a, &least.b})
        for (const auto& [i, j] : both->edge_directions) {
            const DVec<2> e = both->corners[j] - both->corners[i];
            least.offer(normalized(DVec<2>(-e.y, e.x), DVec<2>(0.0)));
        }
}

}  // namespace

template <int D>
double gap_along(const Polytope<D>& a, const Polytope<D>& b, const DVec<D>& n) {
    const DVec<D> origin = middle(a);
    return Located<D>(b, origin).least(n) - Located<D>(a, origin).most(n);
}

template <int D>
Truth<D> truth(const Polytope<D>& a, const Polytope<D>& b, Arithmetic arithmetic) {
    const DVec<D> origin = middle(a);
    const Located<D> at_a(a, origin), at_b(b, origin);
    LeastOver<D> least{at_a, at_b};
    offer_face_normals(least);
    // Some twenty roundings of numbers no larger than this, in unit vectors whose own error moves nothing but the axis.
    const double doubt = 1e-14 * largest_coordinate(a, b);

    Truth<D> result;
    result.overlap = least.extent < std::numeric_limits<double>::infinity() && least.extent > doubt;
    if (result.overlap) {
        result.distance = -least.extent;
        result.normal = least.normal;
    } else {
        const Nearest<D> nearest = nearest_features(at_a, at_b);
        result.distance = std::sqrt(nearest.distance_squared);
        const DVec<D> some = length_squared(least.normal) > 0 ? least.normal : axis<D>(0);
        result.normal = normalized(nearest.on_b - nearest.on_a, some);
        // Of what nearly touches, the direction between two points is rounding, and the best axis knows better.
        const double proved = at_b.least(result.normal) - at_a.most(result.normal);
        result.unproved = result.distance - std::max({proved, -least.extent, 0.0});
        if (result.distance <= doubt && arithmetic == Arithmetic::exact) {
            const LeastExtent<D> exact = least_extent(a, b, arithmetic);
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
