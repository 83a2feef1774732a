#pragma once

// The choice of a broad phase for given boxes.

#include <abut/math/aabb.hpp>

#include <cstdint>
#include <span>

namespace abut {

enum class BroadPhaseKind : std::uint8_t { brute_force, grid, layered_grid, sweep_and_prune, bvh, bsp };

/// How boxes were used of late.
struct BroadPhaseHistory {
    double moved = 1;  ///< the share of the boxes that change between two updates
    /// The number of raycasts and closest queries between two updates, per box. Ten overlap queries count as one ray.
    double queries = 0;
};

/// Chooses the broad phase that is estimated to be fastest for this history. The estimate comes from counts of a sample
/// of at most 1024 boxes and never from a clock, so it is the same on every machine. docs/broad_phases.md has the
/// measurements behind it.
template <int D>
BroadPhaseKind choose_broad_phase(std::span<const Aabb<D>> boxes, const BroadPhaseHistory& history = {});

extern template BroadPhaseKind choose_broad_phase(std::span<const Aabb<2>>, const BroadPhaseHistory&);
extern template BroadPhaseKind choose_broad_phase(std::span<const Aabb<3>>, const BroadPhaseHistory&);

}  // namespace abut
