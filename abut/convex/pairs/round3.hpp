#pragma once

// Closed forms in 3D: the signed distance of a point or a segment from a segment, a box or a triangle, and the depth of
// a point in a polyhedron.
//
// Each result is proven: for disjoint cores by a separating plane at the distance of the closest points, for
// overlapping cores by all faces of their Minkowski difference. If rounding prevents the proof, such as for nearly
// parallel segments that nearly touch, there is no result, and the caller needs a general algorithm.

#include <abut/convex/pairs/pair_answer.hpp>
#include <abut/convex/pairs/placed_cores.hpp>

namespace abut::detail {

/// Whether the core has this number of points, in any placement.
template <int D>
bool is_round_points(const Convex<D>& convex, std::uint32_t count) {
    return convex.core == Core::points && convex.count == count && convex.inner_radius == 0;
}

/// A polyhedron with facets; points, segments and triangles have none.
inline bool is_plain_hull(const Convex<3>& convex) {
    return convex.core == Core::points && convex.count > 3 && convex.facets != nullptr &&
           !convex.facets->normals.empty() && has_similarity_placement(convex);
}

/// The tolerance of a proof, relative to the largest coordinate.
inline constexpr double round3_tolerance = 1e-9;
/// The direction of a smaller distance, relative to the largest coordinate, may be rounding.
inline constexpr double min_round3_gap = 1e-6;

/// Two points on two segments by their parameters from 0 to 1.
struct SegmentParameters {
    double on_a, on_b;
};

/// The parameter clamped to [0, 1].
inline double clamp_to_segment(double part) {
    const double from_start = part > 0 ? part : 0;
    return from_start < 1 ? from_start : 1;
}

/// The closest parameters of nearly parallel segments, or points: an end of one and its projection onto the other.
SegmentParameters closest_end_parameters(const DVec<3>& u, const DVec<3>& v, const DVec<3>& w);

/// The closest points of the segments from a along u and from b along v, w = a - b: the ends of the common
/// perpendicular, or an end of one and its projection onto the other. Ericson, Real-Time Collision Detection (2005),
/// 5.1.9.
inline SegmentParameters closest_parameters(const DVec<3>& u, const DVec<3>& v, const DVec<3>& w) {
    // Below this square of the sine of their angle the segments count as parallel.
    constexpr double parallel = 1e-12;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double whole = uu * vv - uv * uv;
    if (!(whole > parallel * uu * vv)) return closest_end_parameters(u, v, w);
    // All steps run without branches, which can't be predicted. A step that isn't needed changes nothing.
    const double one = 1 / whole, one_u = 1 / uu, one_v = 1 / vv;
    const double first = clamp_to_segment((uv * vw - vv * uw) * one);
    const double on_b = clamp_to_segment((vw + uv * first) * one_v);
    return {clamp_to_segment((uv * on_b - uw) * one_u), on_b};
}

/// A point of a core in the world.
inline DVec<3> core_corner(const Convex<3>& convex, std::uint32_t i) {
    return convex.place.point(DVec<3>(convex.vertices()[i]));
}

/// Whether the core is a point, a segment or a box.
inline bool has_core(const Convex<3>& convex) {
    return is_round_points(convex, 1) || is_round_points(convex, 2) || is_plain_box(convex);
}

/// Calls visit(core) with the placed core of a ball, a segment or a box; returns false for others.
template <class Visit>
bool with_core(const Convex<3>& convex, Visit&& visit) {
    using namespace lanes;
    const auto corner = [&](std::uint32_t i) { return double3(core_corner(convex, i)); };
    if (is_round_points(convex, 1)) return visit(PlacedBall{corner(0), double2(convex.radius)});
    if (is_round_points(convex, 2)) return visit(PlacedSegment{corner(0), corner(1), double2(convex.radius)});
    return is_plain_box(convex) && visit(PlacedBox(convex.place, convex.scale, convex.own[0], convex.radius));
}

// Each function gives the signed distance from A to B, with the balls around them. False: there is no result, and it is
// undefined. Those of round3-inl.h belong to them.

bool distance_of(const PlacedSegment& segment, const PlacedBall& ball, CoresDistance& found);
bool distance_of(const PlacedBox& box, const PlacedSegment& segment, CoresDistance& found);

/// For segments that may be parallel or cross.
bool distance_of_any_segments(const PlacedSegment& a, const PlacedSegment& b, CoresDistance& found);

/// Whether a face of the box proves that the segment is apart from it.
bool is_beyond_a_face(const PlacedBox& box, const PlacedSegment& segment, double within);

bool triangle_point(const Convex<3>& triangle, const Convex<3>& point, SignedDistance<3>& result);
/// The answer is `no` if the plane of the triangle proves that the distance is above `reach`, which is at least 0.
PairAnswer triangle_segment(const Convex<3>& triangle, const Convex<3>& segment, double reach,
                            SignedDistance<3>& result);

enum class TriangleClosest : std::uint8_t { found, beyond, unknown };

/// The closest point of a triangle with the ball around it, and its distance. Returns `beyond` without a result if the
/// distance is above `within`. Returns `unknown` for slivers, and for a point in the core of a triangle with a ball.
TriangleClosest closest_point_on_triangle(const Convex<3>& triangle, const DVec<3>& point, double within,
                                          double& distance, DVec<3>& closest);

/// Whether one face of a polyhedron with facets proves that a point is farther from it than `within`.
bool is_beyond_a_face(const Convex<3>& hull, const DVec<3>& point, double within);

/// Gives a result if the point is inside the polyhedron.
bool hull_point(const Convex<3>& hull, const Convex<3>& point, SignedDistance<3>& result);

}  // namespace abut::detail
