#pragma once

// The distance between two convex cores.
// Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex objects in three-dimensional
// space" (1988); van den Bergen, "A fast and robust GJK implementation" (1999).
//
// Whatever stops the walk, two bounds hold: a point of A - B that was reached, and a plane that parts A - B from the
// origin. Where they agree the answer is proven, and where they don't the caller must ask another way.

#include <abut/convex/search_options.hpp>
#include <abut/convex/simplex.hpp>

#include <limits>

namespace abut {

/// How a walk ended.
enum class GjkExit : std::uint8_t {
    separated,      ///< no point of A - B is nearer to the origin
    beyond,         ///< they are farther apart than was asked
    within,         ///< they are at most as far apart as was asked
    touching,       ///< a point of A - B is the origin as far as doubles can tell
    overlapping,    ///< the origin is inside the simplex
    no_progress,    ///< the distance stopped falling
    bound_reached,  ///< gave up
};

template <int D>
struct GjkResult {
    GjkExit exit = GjkExit::bound_reached;
    Simplex<D> simplex;  ///< of A - B, with the weights of its point closest to the origin
    /// How far that point is from the origin: the gap is at most this. Zero where they touch or overlap.
    double reached = std::numeric_limits<double>::infinity();
    /// Moving B by -proven along `axis` makes them at least touch from outside: the signed distance is at least this.
    double proven = -std::numeric_limits<double>::infinity();
    DVec<D> axis = abut::axis<D>(0);  ///< from A to B, of length 1
    double doubt = 0;                 ///< the bounds agree where they are no farther apart than this

    bool agreed() const { return reached - proven <= doubt; }
};

/// The bound on steps; reaching it takes shapes of thousands of vertices seen along their worst direction.
inline constexpr int gjk_most_steps = 256;

/// Walks until the distance is known or, with a finite `enough`, until it is known whether it is above that.
template <int D>
GjkResult<D> gjk(const CoreDifference<D>& difference, double enough = std::numeric_limits<double>::infinity(),
                 const SearchOptions<D>& options = {});

/// For two that overlap or touch: walks from one side and then from others, until one comes to the origin. Among
/// needles a walk may end early.
template <int D>
GjkResult<D> gjk_common_point(const CoreDifference<D>& difference);

}  // namespace abut
