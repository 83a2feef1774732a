#pragma once

// The half-space: everything on one side of a line or plane, such as the ground.

#include <abut/math/aabb.hpp>
#include <abut/math/linear.hpp>

namespace abut {

/// Solid where dot(normal, p) <= offset. Two of them don't pair.
template <int D>
struct HalfSpace {
    Vec<D> normal{};   ///< of length 1, out of the solid
    float offset = 0;  ///< of its border from the origin, along the normal
};
template <int D>
HalfSpace(glm::vec<D, float>, float) -> HalfSpace<D>;

using HalfSpace2 = HalfSpace<2>;
using HalfSpace3 = HalfSpace<3>;

/// A half-space as the questions see it: placed, in double.
template <int D>
struct Solid {
    DVec<D> normal{0.0};  ///< of length 1
    double offset = 0;
};

template <int D>
Solid<D> solid(const HalfSpace<D>& half_space);

/// The same half-space moved, turned or stretched by `map`.
template <int D>
Solid<D> mapped(const Solid<D>& solid, const Affine<D>& map);

/// By a map that keeps all lengths.
template <int D>
Solid<D> moved(const Solid<D>& solid, const Affine<D>& rigid) {
    return mapped(solid, rigid);
}

/// With its border `radius` farther out.
template <int D>
Solid<D> rounded(const Solid<D>& solid, double radius);

/// Without bound but on the solid's own side, where that is along an axis.
template <int D>
Aabb<D> bounds(const Solid<D>& solid);

template <int D>
Aabb<D> bounds(const HalfSpace<D>& half_space) {
    return bounds(solid(half_space));
}

}  // namespace abut
