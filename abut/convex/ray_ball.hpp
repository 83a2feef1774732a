#pragma once

// Where a beam enters a ball: so little that it is done in place. For .cpp files.

#include <abut/convex/ray_forms.hpp>

namespace abut {

/// Where a beam enters a ball, from outside: the square is taken of the distance at which it passes the middle, which
/// keeps its digits however far the ball is. Below zero, or nothing to go by, where it doesn't.
template <int D>
inline double along_to_ball(const Beam<D>& beam, const DVec<D>& center, double radius, bool& enters) {
    const double nearest = dot(center, beam.direction);
    const double passes = length_squared(center - beam.direction * nearest);
    const double half_chord = radius * radius - passes;
    enters = nearest > 0 && half_chord >= 0;
    return enters ? nearest - std::sqrt(half_chord) : 0;
}

/// One that doesn't begin in it.
template <int D>
RayEntry<D> enter_end(const Beam<D>& beam, const DVec<D>& center, double radius, std::uint32_t number) {
    bool enters = false;
    const double along = along_to_ball(beam, center, radius, enters);
    if (!enters || along > beam.length) return ray_misses<D>();
    // The quotient doesn't wait for the root.
    const DVec<D> normal = (beam.direction * along - center) * (1 / radius);
    return {RayAnswer::enters, along, normal, FeatureKind::vertex, number};
}

template <int D>
RayEntry<D> enter_ball(const Beam<D>& beam, const DVec<D>& center, double radius) {
    if (!(radius > 0)) return {};
    const double about = radius + ray_doubt * (largest(center) + radius);
    if (!(length_squared(center) > about * about)) return {};
    return enter_end(beam, center, radius, 0);
}

}  // namespace abut
