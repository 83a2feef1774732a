#pragma once

// Fast GJK between two cores of vertices, in the frame of A, compiled once for each SIMD target. It answers only if the
// answer is certain: a gap whose two bounds agree, or an axis or a simplex that decides by far more than rounding.
// Robust GJK (gjk.hpp) is the fallback for all other pairs.

#include <abut/convex/gjk/search_options.hpp>
#include <abut/convex/support.hpp>

namespace abut::detail {

/// The simplex before and after a run: vertex indices of A and B, whose pairs are points of A - B.
struct GjkFastSimplex {
    std::array<std::uint32_t, 4> corner_a{}, corner_b{};
    std::uint32_t count = 0;
    DVec<3> toward{0.0};  ///< from A to B. On entry the first search direction if there are no vertices, zero if
                          ///< unknown; on exit as long as the distance
};

/// The closest points. They are right if the two bounds agree.
struct GjkFastDistance {
    double upper_bound = 0;   ///< the distance between a point of A and a point of B
    double lower_bound = -1;  ///< the width of a slab between the cores
    DVec<3> on_a{0.0};
};

enum class GjkFastExit : std::uint8_t {
    separated,    ///< `toward` separates the cores by more than `max_distance`, by far more than rounding
    overlapping,  ///< the origin is inside the simplex, by far more than rounding
    converged,    ///< no point of A - B is nearer to the origin
    undecided,    ///< the distance is too small to decide
};

/// Whether fast GJK handles these cores: both have vertices and a similarity placement, and they are not both boxes.
bool gjk_fast_applies(const Convex<3>& a, const Convex<3>& b);

/// Iterates until no point of A - B is nearer to the origin. `gap` is set if the exit is `converged`.
GjkFastExit gjk_fast_distance(const Convex<3>& a, const Convex<3>& b, GjkFastSimplex& simplex, GjkFastDistance& gap,
                              Trace<3>* trace);

/// Iterates until it is certain whether the distance is above `max_distance`, or until that can't be decided.
GjkFastExit gjk_fast_overlap(const Convex<3>& a, const Convex<3>& b, double max_distance, GjkFastSimplex& simplex,
                             Trace<3>* trace);

}  // namespace abut::detail
