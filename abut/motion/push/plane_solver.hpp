#pragma once

// The move nearest to a target that satisfies contact planes. For .cpp files.

#include <abut/math/dvec.hpp>

#include <span>

namespace abut::detail {

/// Constrains moves v to dot(normal, v) >= -clearance. A negative clearance requires a separating move.
template <int D>
struct MovePlane {
    DVec<D> normal;  ///< unit normal, away from the obstacle
    double clearance = 0;
};

/// Maximum number of planes; further ones are ignored.
inline constexpr std::size_t max_move_planes = 32;

/// Writes the feasible move nearest to `target` to `move`. Returns false, with `move` undefined, if there is none. The
/// solution is unique. The planes are added one by one; if one is violated, the solution lies in that plane and is
/// found among the earlier planes in one dimension less (R. Seidel, "Small-dimensional linear programming and convex
/// hulls made easy", 1991). A violation of up to `tolerance` is accepted.
template <int D>
bool nearest_move(std::span<const MovePlane<D>> planes, const DVec<D>& target, double tolerance, DVec<D>& move);

}  // namespace abut::detail
