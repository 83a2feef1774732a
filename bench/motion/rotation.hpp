#pragma once

// Sweeps of boxes with rotation, and the peers' times of impact.

#include "../bench.hpp"
#include <abut/math/motion.hpp>
#include <abut/shape/box.hpp>

#include <vector>

namespace abut::bench {

template <int D>
struct RotatingBox {
    Box<D> box;  ///< about the origin of the moving frame
    Pose<D> from, to;
    Angle<D> turn;  ///< rotation between the poses: by up to half a turn
};
template <int D>
struct RotatingPair {
    RotatingBox<D> a, b;
};
template <int D>
struct RotationScene {
    std::vector<RotatingPair<D>> pairs;
};

// The fraction of impact, or `no_impact`.

constexpr double no_impact = 2;

Side box2d_rotation(const RotationScene<2>& scene);
Side bullet_rotation(const RotationScene<3>& scene);
Side fcl_rotation(const RotationScene<3>& scene);

}  // namespace abut::bench
