#pragma once

// The separating axis test (SAT) of two polygons. The faces of the Minkowski difference A - B are those of A and the
// reversed faces of B. Gottschalk, Lin, Manocha, "OBBTree" (1996).

#include <abut/convex/gjk/minkowski_difference.hpp>
#include <abut/convex/gjk/trace.hpp>

#include <limits>

namespace abut::detail {

/// The axis of minimum overlap or of maximum separation of two polygons.
struct SeparatingAxis {
    DVec<2> normal{0.0};  ///< from A to B, of length 1; zero if no axis was tested
    /// Moving B by this along the normal separates the two. A negative value is a lower bound of their gap.
    double extent = std::numeric_limits<double>::infinity();
};

/// Tests two polygons (`has_features`) without their radii. The extent is the penetration depth if they overlap, and
/// minus a lower bound of the gap if not. For two segments, or a segment that lies along a flat shape, the axis of
/// minimum depth may be missing: the result is valid but need not be the minimum. The test ends at the first gap wider
/// than `max_distance`. It allocates only for the trace.
SeparatingAxis separating_axis(const CoreDifference<2>& difference,
                               double max_distance = std::numeric_limits<double>::infinity(),
                               Trace<2>* trace = nullptr);

}  // namespace abut::detail
