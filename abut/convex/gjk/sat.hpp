#pragma once

// The separating axis test (SAT) of two polytopes.
//
// The faces of the Minkowski difference A - B are the faces of A, the reversed faces of B, and in 3D the parallelograms
// of an edge of A and an edge of B whose arcs cross on the Gauss map. Face normals alone give a wrong answer for
// several in a hundred disjoint pairs of boxes. Gottschalk, Lin, Manocha, "OBBTree" (1996), for boxes; Gregorius, "The
// separating axis test between convex polyhedra" (Game Developers Conference 2013), for the arcs.

#include <abut/convex/gjk/minkowski_difference.hpp>
#include <abut/convex/gjk/trace.hpp>

#include <limits>

namespace abut::detail {

/// The projection of a core onto an axis.
struct Interval {
    double min, max;
};

template <int D>
Interval interval(const Convex<D>& core, const DVec<D>& axis);

/// The axis of minimum overlap or of maximum separation of two polytopes.
template <int D>
struct SeparatingAxis {
    DVec<D> normal{0.0};  ///< from A to B, of length 1; zero if no axis was tested
    /// Moving B by this along the normal separates the two. A negative value is a lower bound of their gap.
    double extent = std::numeric_limits<double>::infinity();
};

/// Tests two polytopes (`has_features`) without their radii. The extent is the penetration depth if they overlap, and
/// minus a lower bound of the gap if not. For two segments, or a segment that lies along a flat shape, the axis of
/// minimum depth may be missing: the result is valid but need not be the minimum. The test ends at the first gap wider
/// than `max_distance`. It allocates only for the trace.
SeparatingAxis<2> separating_axis(const CoreDifference<2>& difference,
                                  double max_distance = std::numeric_limits<double>::infinity(),
                                  Trace<2>* trace = nullptr);
SeparatingAxis<3> separating_axis(const CoreDifference<3>& difference,
                                  double max_distance = std::numeric_limits<double>::infinity(),
                                  Trace<3>* trace = nullptr);

}  // namespace abut::detail
