#pragma once

// Separating axes: the few directions along which two polytopes can be parted, tried one after the other.
//
// The faces of A - B are the faces of A, the turned faces of B, and in 3D the parallelograms that an edge of A and an
// edge of B span where their arcs cross on the Gauss map. Face normals alone are wrong for several in a hundred boxes
// that are apart. Gottschalk, Lin, Manocha, "OBBTree" (1996), for boxes; Gregorius, "The separating axis test between
// convex polyhedra" (Game Developers Conference 2013), for the arcs.

#include <abut/convex/minkowski_difference.hpp>
#include <abut/convex/trace.hpp>

#include <limits>

namespace abut {

/// What a core covers of an axis.
struct Interval {
    double min, max;
};

template <int D>
Interval interval(const Convex<D>& core, const DVec<D>& axis);

/// The axis along which two polytopes overlap least, or are farthest apart.
template <int D>
struct SeparatingAxis {
    DVec<D> normal{0.0};  ///< from A to B, of length 1; zero where no axis was tried
    /// How far moving B along the normal parts them: below zero they are apart by that much at least.
    double extent = std::numeric_limits<double>::infinity();
};

/// Of two polytopes (`has_features`), without their radii. The extent is the depth where they overlap, and some lower
/// bound of the gap where not. Two segments, or a segment and a flat thing that it lies along, can lack the axis that
/// matters: what is found is valid, but needn't be the least. Ends at the first gap wider than `enough`. Never
/// allocates but for the trace.
SeparatingAxis<2> separating_axis(const CoreDifference<2>& difference,
                                  double enough = std::numeric_limits<double>::infinity(), Trace<2>* trace = nullptr);
SeparatingAxis<3> separating_axis(const CoreDifference<3>& difference,
                                  double enough = std::numeric_limits<double>::infinity(), Trace<3>* trace = nullptr);

}  // namespace abut
