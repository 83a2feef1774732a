#pragma once

// Boxes that move and turn, from pose to pose in one step, and the peers that say when two of them meet.

#include "bench.hpp"
#include <abut/math/motion.hpp>
#include <abut/shape/box.hpp>

#include <vector>

namespace abut::bench {

template <int D>
struct TurningBox {
    Box<D> box;  ///< about the origin of what moves
    Pose<D> from, to;
    Angle<D> turn;  ///< what leads from the one to the other: by up to half a turn
};
template <int D>
struct TurningPair {
    TurningBox<D> a, b;
};
template <int D>
struct TurningScene {
    std::vector<TurningPair<D>> pairs;
};

// The fraction at which they meet, or `no_meeting`.

constexpr double no_meeting = 2;

Side box2d_turning(const TurningScene<2>& scene);
Side bullet_turning(const TurningScene<3>& scene);
Side fcl_turning(const TurningScene<3>& scene);

}  // namespace abut::bench
