#pragma once

// The overlap of two polytopes: one is cut with the half-spaces of the other, one after the other, and what is left at
// the end is in both.
//
// A cut goes around each face as Sutherland and Hodgman did ("Reentrant polygon clipping", 1974) and closes what it has
// opened with a new face. Corners are told apart as in front of the plane, behind it or on it, to within the rounding
// of their coordinates; so what touches in a face, an edge or a corner leaves exactly that.

#include <abut/convex/support.hpp>
#include <abut/convex/trace.hpp>

#include <cstdint>
#include <vector>

namespace abut {

/// The half-space dot(normal, p) <= offset.
template <int D>
struct ClipPlane {
    DVec<D> normal{0.0};  ///< of length 1
    double offset = 0;
};

/// A convex polytope by its corners and the loops around its faces; in 2D the one loop around it. A flat polygon in
/// space has two loops, back to back; a segment is a loop of two corners, a point of one. No loops: the empty set.
/// Every edge is run along as often one way as the other in 3D.
template <int D>
struct ClipBody {
    std::vector<DVec<D>> points;
    std::vector<std::vector<std::uint32_t>> loops;

    bool empty() const { return loops.empty(); }
};

/// Half-spaces that hold a polytope, with each of its corners.
template <int D>
struct ClipPlanes {
    std::vector<ClipPlane<D>> planes;
    double excess = 0;  ///< at most so far do points in all of them lie from the polytope
};

/// A polytope seen from `origin`: a box or the hull of points, with no ball around it.
template <int D>
ClipBody<D> clip_body(const Convex<D>& convex, const DVec<D>& origin);

/// The half-spaces of the faces; and of flat sets those of both sides and of the edges. Corners of a face of a
/// polyhedron may lie out of its plane by `hull_flatness` of its extent, and then its half-space is as much too large.
ClipPlanes<2> clip_planes(const ClipBody<2>& body);
ClipPlanes<3> clip_planes(const ClipBody<3>& body);

/// Cuts away what is in front of the plane. Corners within `doubt` of it lie on it, and stay where they are.
/// Returns the new face, or several where rounding parts it; none in 2D.
template <int D>
std::vector<std::vector<std::uint32_t>> cut(ClipBody<D>& body, const ClipPlane<D>& plane, double doubt);

/// Points of the world whose hull is the overlap of two polytopes, to within 2^-23 of the size of the larger one; none
/// where they have no point in common to within the rounding of doubles. The smaller one is cut with the larger one's
/// half-spaces, so that what lies inside of another comes back as it is.
template <int D>
std::vector<DVec<D>> clip(const Convex<D>& a, const Convex<D>& b, Trace<D>* trace = nullptr);

}  // namespace abut
