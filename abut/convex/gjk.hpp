#pragma once

// The distance between two convex cores.
// Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex objects in three-dimensional
// space" (1988); van den Bergen, "A fast and robust GJK implementation" (1999).

#include <abut/convex/simplex.hpp>

#include <limits>

namespace abut {

/// How a walk ended.
enum class GjkExit : std::uint8_t {
    separated,      ///< the distance is known to the last digits
    beyond,         ///< they are farther apart than was asked
    within,         ///< they are at most as far apart as was asked
    touching,       ///< the distance is zero as far as doubles can tell
    overlapping,    ///< the origin is inside the simplex
    no_progress,    ///< the distance stopped falling: it is known as well as rounding allows
    bound_reached,  ///< gave up; the distance is an upper bound
};

template <int D>
struct GjkResult {
    GjkExit exit = GjkExit::bound_reached;
    DVec<D> closest{0.0};  ///< the point of A - B closest to the origin; zero for overlapping
    Simplex<D> simplex;    ///< its face there, with weights

    bool apart() const { return exit != GjkExit::touching && exit != GjkExit::overlapping; }
};

/// The bound on steps; reaching it takes shapes of thousands of vertices seen along their worst direction.
inline constexpr int gjk_most_steps = 256;

/// Walks until the distance is known or, with a finite `enough`, until it is known whether it is above that.
template <int D>
GjkResult<D> gjk(const CoreDifference<D>& difference, double enough = std::numeric_limits<double>::infinity());

}  // namespace abut
