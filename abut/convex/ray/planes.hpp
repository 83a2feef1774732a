#pragma once

// Clips a line with many planes in SIMD. The result has the same bits on every target.

#include <abut/convex/ray/closed_forms.hpp>

namespace abut::detail {

struct PlaneCut {
    RayCut cut;
    double beside =
        -std::numeric_limits<double>::infinity();  ///< the greatest height of the line over a parallel plane
    std::size_t in = 0, out = 0;  ///< the planes of `cut`, the first of several; the number of planes if there is none
};

/// The planes are dot(normal, p) == offset + out, with the solid behind all of them.
PlaneCut cut_by_planes(std::span<const Vec3> normals, std::span<const double> offsets, double out,
                       const DVec<3>& origin, const DVec<3>& direction);

}  // namespace abut::detail
