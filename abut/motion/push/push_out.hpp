#pragma once

// Depenetration of a mover by contact planes. For .cpp files.

#include <abut/motion/mover/nearby_surface.hpp>

namespace abut::detail {

template <int D>
struct PushOut {
    DVec<D> push{0.0};
    double depth = 0;  ///< remaining penetration depth
};

/// Pushes a shape out of its contacts by minimal translations against contact planes; each push is swept and stopped by
/// obstacles. Nothing happens if all gaps are at least `trigger`. Otherwise gaps become `target`, which is larger, or 0
/// if there is no space. `reach` is the range of contacts, at least `target`.
template <int D>
PushOut<D> push_out(NearbySurface<D>& near, const DVec<D>& at, double trigger, double target, double reach);

}  // namespace abut::detail
