#pragma once

// The way out of what a shape is in. For .cpp files.

#include <abut/motion/near_surface.hpp>

namespace abut {

template <int D>
struct WayOut {
    DVec<D> push{0.0};
    double depth = 0;  ///< what is left to go, in the deepest place
};

/// Least pushes that leave all that is near at once, by planes; each is looked after, and what lies on its way stops
/// it. Nothing is done as long as all is farther than `enough`; otherwise it goes as far as `wanted`, which is more,
/// or if there is no room for that, to where it just touches. `reach` is how far contacts are looked for, `wanted` or
/// more.
template <int D>
WayOut<D> way_out(NearSurface<D>& near, const DVec<D>& at, double enough, double wanted, double reach);

}  // namespace abut
