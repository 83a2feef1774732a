#pragma once

// Ray against ball. Inline, because it is short. For .cpp files.

#include <abut/convex/ray/closed_forms.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {

/// The parameter at which a ray from outside enters a ball. It uses the squared distance of the ray from the centre,
/// which stays precise for distant balls. `enters` is false if the ray misses.
template <int D>
inline double along_to_ball(const DRay<D>& ray, const DVec<D>& center, double radius, bool& enters) {
    const double nearest = dot(center, ray.direction);
    const double passes = length_squared(center - ray.direction * nearest);
    const double half_chord = radius * radius - passes;
    enters = nearest > 0 && half_chord >= 0;
    return enters ? nearest - square_root(half_chord) : 0;
}

/// For a ray that starts outside.
template <int D>
RayEntry<D> enter_end(const DRay<D>& ray, const DVec<D>& center, double radius, std::uint32_t number) {
    bool enters = false;
    const double along = along_to_ball(ray, center, radius, enters);
    if (!enters || along > ray.length) return ray_misses<D>();
    // The division runs in parallel with the root.
    const DVec<D> normal = (ray.direction * along - center) * (1 / radius);
    return {RayAnswer::enters, along, normal, FeatureKind::vertex, number};
}

template <int D>
RayEntry<D> enter_ball(const DRay<D>& ray, const DVec<D>& center, double radius) {
    if (!(radius > 0)) return {};
    const double about = radius + ray_tolerance * (largest(center) + radius);
    if (!(length_squared(center) > about * about)) return {};
    return enter_end(ray, center, radius, 0);
}

}  // namespace abut::detail
