#pragma once

// Which broad phase suits some boxes.

#include <abut/math/aabb.hpp>

#include <cstdint>
#include <span>

namespace abut {

enum class BroadPhaseKind : std::uint8_t { brute_force, grid, layered_grid, sweep_and_prune, bvh, bsp };

/// What is known of how boxes are used.
struct BroadPhaseHistory {
    double moved = 1;  ///< the share of the boxes that change from one update to the next
    /// Rays, and searches for what is near, from one update to the next, for each box; ten regions count as a ray.
    double asked = 0;
};

/// The broad phase that soonest does what the history tells, by counts of a sample of the boxes and never by a clock:
/// the same on every machine. Looks at 1024 boxes at most. docs/broad_phases.md has the numbers that it rests on.
template <int D>
BroadPhaseKind choose_broad_phase(std::span<const Aabb<D>> boxes, const BroadPhaseHistory& history = {});

extern template BroadPhaseKind choose_broad_phase(std::span<const Aabb<2>>, const BroadPhaseHistory&);
extern template BroadPhaseKind choose_broad_phase(std::span<const Aabb<3>>, const BroadPhaseHistory&);

}  // namespace abut
