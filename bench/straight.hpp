#pragma once

// Linear sweeps of convex shapes, and the peers' times of impact.

#include "../scenes/convex_pairs.hpp"
#include "bench.hpp"

#include <vector>

namespace abut::bench {

template <int D>
struct StraightScene {
    scenes::ConvexPairs<D> pairs;
    std::vector<Vec<D>> motions;  ///< of A, one per pair
};

// The fraction of A's motion, or `no_touch`.

constexpr double no_touch = -1;

/// Conservative advancement.
Side bullet_straight(const StraightScene<3>& scene);
/// A ray cast into the Minkowski difference with a simplex, as btCollisionWorld's convex sweeps, and by advancement
/// with GJK.
Side bullet_straight_by_simplex(const StraightScene<3>& scene);
Side bullet_straight_by_gjk(const StraightScene<3>& scene);
/// Conservative advancement of boxes.
Side fcl_straight(const StraightScene<3>& scene);
/// b2ShapeCast, and the time of impact without rotation.
Side box2d_straight(const StraightScene<2>& scene);
Side box2d_straight_by_impact(const StraightScene<2>& scene);

}  // namespace abut::bench
