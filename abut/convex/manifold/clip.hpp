#pragma once

// The intersection of two polytopes: one is cut with the half-spaces of the other, one after the other.
//
// A cut clips each face by Sutherland and Hodgman ("Reentrant polygon clipping", 1974) and closes the opening with a
// new face. Corners are classified as in front of the plane, behind it or on it, to the rounding of their coordinates.
// So polytopes that touch in a face, an edge or a corner leave exactly that.

#include <abut/convex/gjk/trace.hpp>
#include <abut/convex/support.hpp>

#include <cstdint>
#include <vector>

namespace abut::detail {

/// The half-space dot(normal, p) <= offset.
template <int D>
struct ClipPlane {
    DVec<D> normal{0.0};  ///< of length 1
    double offset = 0;
};

/// A convex polytope by its corners and the loops around its faces; in 2D one loop. A flat polygon in 3D has two loops,
/// back to back; a segment is a loop of two corners, a point of one. No loops: the empty set. In 3D the loops run along
/// every edge as often in one direction as in the other.
template <int D>
struct ClipBody {
    std::vector<DVec<D>> points;
    std::vector<std::vector<std::uint32_t>> loops;

    bool empty() const { return loops.empty(); }
};

/// Half-spaces that contain a polytope and all its corners.
template <int D>
struct ClipPlanes {
    std::vector<ClipPlane<D>> planes;
    double excess = 0;  ///< the maximum distance of their intersection from the polytope
};

/// A polytope relative to `origin`: a box or the hull of points, without a ball.
template <int D>
ClipBody<D> clip_body(const Convex<D>& convex, const DVec<D>& origin);

/// The half-spaces of the faces; for flat sets those of both sides and of the edges. Corners of a polyhedron's face may
/// lie out of its plane by `hull_flatness` of the extent; then its half-space is too large by as much.
ClipPlanes<2> clip_planes(const ClipBody<2>& body);
ClipPlanes<3> clip_planes(const ClipBody<3>& body);

/// Removes the part in front of the plane. Corners within `tolerance` of it lie on it, and stay in place. Returns the
/// new face, or several if rounding splits it; none in 2D.
template <int D>
std::vector<std::vector<std::uint32_t>> cut(ClipBody<D>& body, const ClipPlane<D>& plane, double tolerance);

/// Points in the world whose hull is the intersection of two polytopes, to within 2^-23 of the size of the larger one.
/// It is empty if they share no point to the rounding of doubles. The smaller one is cut with the half-spaces of the
/// larger one, so that a polytope inside the other stays as it is.
template <int D>
std::vector<DVec<D>> clip(const Convex<D>& a, const Convex<D>& b, Trace<D>* trace = nullptr);

}  // namespace abut::detail
