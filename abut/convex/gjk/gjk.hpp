#pragma once

// The distance between two convex cores by GJK.
// Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex objects in three-dimensional
// space" (1988); van den Bergen, "A fast and robust GJK implementation" (1999).
//
// Every exit gives two bounds of the distance: a point of the Minkowski difference A - B, and a plane that separates A
// - B from the origin. The distance is proven if the two bounds agree. If they differ, the caller needs another method.

#include <abut/convex/gjk/search_options.hpp>
#include <abut/convex/gjk/simplex.hpp>

#include <limits>

namespace abut::detail {

/// Why the iteration ended.
enum class GjkExit : std::uint8_t {
    separated,      ///< no point of A - B is nearer to the origin
    beyond,         ///< the distance is above the maximum distance of the query
    within,         ///< the distance is at most the maximum distance of the query
    touching,       ///< a point of A - B is the origin, to the rounding of doubles
    overlapping,    ///< the origin is inside the simplex
    no_progress,    ///< the distance stopped decreasing
    bound_reached,  ///< the bound on iterations was reached
};

template <int D>
struct GjkResult {
    GjkExit exit = GjkExit::bound_reached;
    Simplex<D> simplex;  ///< of A - B, with the weights of its point closest to the origin
    /// The distance of that point from the origin, an upper bound of the gap. Zero if the cores touch or overlap.
    double upper_bound = std::numeric_limits<double>::infinity();
    /// A lower bound of the signed distance: moving B by -lower_bound along `axis` leaves the cores disjoint or
    /// touching.
    double lower_bound = -std::numeric_limits<double>::infinity();
    DVec<D> axis = detail::axis<D>(0);  ///< from A to B, of length 1
    double tolerance = 0;               ///< the bounds agree if they differ by at most this

    bool converged() const { return upper_bound - lower_bound <= tolerance; }
};

/// The bound on iterations. Shapes of thousands of vertices reach it in their worst direction.
inline constexpr int gjk_max_iterations = 256;

/// Iterates until the distance is known. With a finite `max_distance` it ends as soon as the comparison with it is
/// decided.
template <int D>
GjkResult<D> gjk(const CoreDifference<D>& difference, double max_distance = std::numeric_limits<double>::infinity(),
                 const SearchOptions<D>& options = {});

/// A common point of two cores that overlap or touch: starts GJK from several directions until a simplex reaches the
/// origin. On needles a single run may stop early.
template <int D>
GjkResult<D> gjk_common_point(const CoreDifference<D>& difference);

}  // namespace abut::detail
