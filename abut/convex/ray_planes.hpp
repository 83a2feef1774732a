#pragma once

// Cutting a line off at many planes, several at a time. The answer is the same bits on every vector unit.

#include <abut/convex/ray_forms.hpp>

namespace abut {

struct PlaneCut {
    RayCut cut;
    double beside = -std::numeric_limits<double>::infinity();  ///< the greatest height over a plane along the line
    std::size_t in = 0, out = 0;  ///< the planes of `cut`, the first of several; their number where there is none
};

/// The planes are dot(normal, p) == offset + out, all of the solid behind them.
PlaneCut cut_by_planes(std::span<const Vec3> normals, std::span<const double> offsets, double out,
                       const DVec<3>& origin, const DVec<3>& direction);

}  // namespace abut
