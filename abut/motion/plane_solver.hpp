#pragma once

// The move nearest to a wanted one that some planes allow. For .cpp files.

#include <abut/math/dvec.hpp>

#include <span>

namespace abut {

/// Allows the moves v with dot(normal, v) >= -room: so far it may be approached; below zero, it must be left by that.
template <int D>
struct MovePlane {
    DVec<D> normal;  ///< of length 1, away from what is behind it
    double room = 0;
};

/// More planes than these aren't looked at.
inline constexpr std::size_t most_move_planes = 32;

/// Puts the nearest move to `wanted` into `move`; false, and it is of no use, where there is none. It is the only one,
/// however steep the corners: planes come one by one, and where one forbids the move so far, the nearest one lies in
/// that plane, to be found among those before it with one dimension less (R. Seidel, "Small-dimensional linear
/// programming and convex hulls made easy", 1991). What is short of a plane by `tolerance` counts as allowed.
template <int D>
bool nearest_move(std::span<const MovePlane<D>> planes, const DVec<D>& wanted, double tolerance, DVec<D>& move);

}  // namespace abut
