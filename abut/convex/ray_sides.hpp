#pragma once

// Where a beam enters a polygon that has its sides in rows: so little that it is done in place. For .cpp files.

#include <abut/convex/ray_forms.hpp>

namespace abut {

/// In the polygon's own frame, with a ball of `radius` around it.
inline RayEntry<2> enter_sides(const Beam<2>& beam, const Sides& sides, double radius) {
    RayCut cut;
    cut.lower = -1;  // what lies behind the beam's origin is all the same
    std::uint32_t in = 0;
    double beside = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < sides.count; ++i) {
        const double x = sides.normal_x[i], y = sides.normal_y[i];
        const double height = (x * beam.origin.x + y * beam.origin.y) - (sides.offset[i] + radius);
        const double sinks = -(x * beam.direction.x + y * beam.direction.y);
        // Compared before they are divided: most sides cut nothing off.
        if (sinks > 0) {
            if (!(height > cut.lower * sinks)) continue;
            cut.lower = height / sinks;
            cut.slope_in = sinks;
            in = i;
        } else if (sinks < 0) {
            if (!(height > cut.upper * sinks)) continue;
            cut.upper = height / sinks;
            cut.slope_out = -sinks;
        } else {
            beside = std::max(beside, height);
        }
    }
    if (cut.lower > beam.length) return ray_misses<2>();
    const double doubt =
        ray_doubt * (largest(beam.origin) + std::max(std::abs(sides.x[0]), std::abs(sides.y[0])) + radius);
    if (beside > 0) return beside > doubt ? ray_misses<2>() : RayEntry<2>();
    RayEntry<2> result;
    result.answer = cut.answer(beam.length, doubt);
    if (result.answer != RayAnswer::enters) return result;

    // Where the corner is sharp, its two lines may meet elsewhere than it is; and round a corner the ball is round.
    const double part = dot(beam.at(cut.lower) - sides.corner(in), sides.along(in));
    const double slack = radius > 0 ? 0 : doubt;
    const bool skims = cut.slope_in < 1e-6 * length(beam.direction);
    if (skims || !(part >= -slack && part <= sides.length(in) + slack)) return {};
    result.along = cut.lower;
    result.normal = sides.normal(in);
    result.kind = FeatureKind::edge;
    result.index = edge_index(in, sides.after(in));
    return result;
}

}  // namespace abut
