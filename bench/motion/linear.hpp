#pragma once

// Linear sweeps of convex shapes, and the peers' times of impact.

#include "../../scenes/convex_pairs.hpp"
#include "../bench.hpp"

#include <vector>

namespace abut::bench {

template <int D>
struct LinearScene {
    scenes::ConvexPairs<D> pairs;
    std::vector<Vec<D>> motions;  ///< of A, one per pair
};

// The fraction of A's motion, or `no_touch`.

constexpr double no_touch = -1;

/// Conservative advancement.
Side bullet_linear(const LinearScene<3>& scene);
/// A ray cast into the Minkowski difference with a simplex, as btCollisionWorld's convex sweeps, and by advancement
/// with GJK.
Side bullet_linear_by_simplex(const LinearScene<3>& scene);
Side bullet_linear_by_gjk(const LinearScene<3>& scene);
/// Conservative advancement of boxes.
Side fcl_linear(const LinearScene<3>& scene);
/// b2ShapeCast, and the time of impact without rotation.
Side box2d_linear(const LinearScene<2>& scene);
Side box2d_linear_by_impact(const LinearScene<2>& scene);

}  // namespace abut::bench
