#pragma once

// Where a point or a segment is nearest to a segment, a box or a triangle, or how deep in it, by a closed form; and how
// deep a point is in a polyhedron.
//
// Answers are proven before they are given: by a plane between the two that is as far from both as the places found on
// them are apart; or where they overlap, by all the sides that their difference has. Where rounding leaves a doubt,
// such as for nearly parallel segments that nearly touch, there is no answer, and a search has to find it.

#include <abut/convex/signed_distance.hpp>

namespace abut {

/// The core of so many points; placed in any way.
template <int D>
bool is_round_points(const Convex<D>& convex, std::uint32_t count) {
    return convex.core == Core::points && convex.count == count && convex.inner_radius == 0;
}

/// A polyhedron with sides of its own: a point, a segment or a triangle are what they are.
inline bool is_plain_hull(const Convex<3>& convex) {
    return convex.core == Core::points && convex.count > 3 && convex.facets != nullptr &&
           !convex.facets->normals.empty() && keeps_its_form(convex);
}

/// Two places on two segments, by their parts of the way.
struct Places {
    double on_a, on_b;
};

/// The nearest part of the way that there is.
inline double part_on_segment(double part) {
    const double from_start = part > 0 ? part : 0;
    return from_start < 1 ? from_start : 1;
}

/// Of nearly parallel segments, or points: at an end of one and its foot on the other.
template <int D>
Places nearest_ends(const DVec<D>& u, const DVec<D>& v, const DVec<D>& w);

/// Where the segments from a along u and from b along v are nearest, w = a - b: the feet of the common perpendicular,
/// or an end of one and its foot on the other. Ericson, Real-Time Collision Detection (2005), 5.1.9.
template <int D>
inline Places nearest_places(const DVec<D>& u, const DVec<D>& v, const DVec<D>& w) {
    // Below this square of the sine of their angle they are taken for parallel.
    constexpr double parallel = 1e-12;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double whole = uu * vv - uv * uv;
    if (!(whole > parallel * uu * vv)) return nearest_ends(u, v, w);
    // Each step is taken, needed or not: which it is can't be guessed, and what is best already stays as it is.
    const double one = 1 / whole, one_u = 1 / uu, one_v = 1 / vv;
    const double first = part_on_segment((uv * vw - vv * uw) * one);
    const double on_b = part_on_segment((vw + uv * first) * one_v);
    return {part_on_segment((uv * on_b - uw) * one_u), on_b};
}

/// A point of a core in the world.
template <int D>
inline DVec<D> core_corner(const Convex<D>& convex, std::uint32_t i) {
    return convex.place.point(DVec<D>(convex.vertices()[i]));
}

// Each of these gives the signed distance from A to B, with the balls around them. False where there is no answer; then
// `result` is of no use.

bool point_point(const Convex<3>& a, const Convex<3>& b, SignedDistance<3>& result);
bool segment_point(const Convex<3>& segment, const Convex<3>& point, SignedDistance<3>& result);

template <int D>
bool segment_segment(const Convex<D>& a, const Convex<D>& b, SignedDistance<D>& result);

bool box_point(const Convex<3>& box, const Convex<3>& point, SignedDistance<3>& result);
bool box_segment(const Convex<3>& box, const Convex<3>& segment, SignedDistance<3>& result);

bool triangle_point(const Convex<3>& triangle, const Convex<3>& point, SignedDistance<3>& result);
bool triangle_segment(const Convex<3>& triangle, const Convex<3>& segment, SignedDistance<3>& result);

enum class TriangleFoot : std::uint8_t { found, beyond, unknown };

/// The place of a triangle, with the ball around it, that is nearest to a point, and how far it is. `beyond` where that
/// is farther than `within`, and nothing is told; unknown for slivers, and for a point in the core if there is a ball.
TriangleFoot foot_on_triangle(const Convex<3>& triangle, const DVec<3>& point, double within, double& distance,
                              DVec<3>& foot);

/// An answer where the point is inside the polyhedron.
bool hull_point(const Convex<3>& hull, const Convex<3>& point, SignedDistance<3>& result);

}  // namespace abut
