#pragma once

// Ray against a polygon in SoA. Inline, because it is short. For .cpp files.

#include <abut/convex/ray/closed_forms.hpp>

namespace abut::detail {

/// In the polygon's own frame, with a ball of `radius` around it.
inline RayEntry<2> enter_polygon_soa(const DRay<2>& ray, const PolygonSoa& sides, double radius) {
    RayCut cut;
    cut.lower = -1;  // the part behind the ray's origin doesn't matter
    std::uint32_t in = 0;
    double beside = -std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < sides.count; ++i) {
        const double x = sides.normal_x(i), y = sides.normal_y(i);
        const double height = (x * ray.origin.x + y * ray.origin.y) - (sides.offset(i) + radius);
        const double descent = -(x * ray.direction.x + y * ray.direction.y);
        // Compared before the division: most edges clip nothing.
        if (descent > 0) {
            if (!(height > cut.lower * descent)) continue;
            cut.lower = height / descent;
            cut.slope_in = descent;
            in = i;
        } else if (descent < 0) {
            if (!(height > cut.upper * descent)) continue;
            cut.upper = height / descent;
            cut.slope_out = -descent;
        } else {
            beside = std::max(beside, height);
        }
    }
    if (cut.lower > ray.length) return ray_misses<2>();
    const double tolerance =
        ray_tolerance * (largest(ray.origin) + std::max(std::abs(sides.x(0)), std::abs(sides.y(0))) + radius);
    if (beside > 0) return beside > tolerance ? ray_misses<2>() : RayEntry<2>();
    RayEntry<2> result;
    result.answer = cut.answer(ray.length, tolerance);
    if (result.answer != RayAnswer::enters) return result;

    // At a sharp corner the two lines may cross away from it, and around a corner the ball is round.
    const double part = dot(ray.at(cut.lower) - sides.corner(in), sides.along(in));
    const double edge_tolerance = radius > 0 ? 0 : tolerance;
    const bool skims = cut.slope_in < 1e-6 * length(ray.direction);
    if (skims || !(part >= -edge_tolerance && part <= sides.length(in) + edge_tolerance)) return {};
    result.along = cut.lower;
    result.normal = sides.normal(in);
    result.kind = FeatureKind::edge;
    result.index = edge_index(in, sides.after(in));
    return result;
}

}  // namespace abut::detail
