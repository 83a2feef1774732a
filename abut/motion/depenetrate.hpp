#pragma once

// Depenetration: a short translation that separates a shape from everything it overlaps.

#include <abut/world/world.hpp>

namespace abut {

template <int D>
struct Depenetration {
    Vec<D> push{};    ///< translation to add to the shape's position
    float depth = 0;  ///< penetration depth that remains after the push; 0: the shape is free

    /// True if the push separates the shape.
    explicit operator bool() const { return depth == 0; }
};

}  // namespace abut

namespace abut::detail {

template <int D>
Depenetration<D> depenetrate_convex(const Convex<D>& shape, const World<D>& world, const Filter& filter);

}  // namespace abut::detail

namespace abut {

/// Finds a short push that separates a convex shape from everything it overlaps. It searches along lines: out of each
/// part, out of all parts at once, and in evenly spread directions. From each free point it slides back towards the
/// start. Measured in 2D with up to eight overlapping convex parts, the push is the shortest one in 97 % of the cases,
/// to within 2 %. Obstacles between the start and the end are ignored.
///
/// A free shape stays where it is; otherwise it ends 1e-4 of its size from what it overlapped. If no line leaves the
/// obstacles, such as between two half-spaces, or needs more than 256 parts, the shape stays and `depth` is its deepest
/// penetration. Doesn't allocate.
template <Shape S>
requires(detail::is_convex_view<detail::ViewOf<S>>) Depenetration<dimension<S>> depenetrate(
    const S& shape, const World<dimension<S>>& world, const Filter& filter = {}) {
    detail::clear_upper_halves();
    return detail::depenetrate_convex<dimension<S>>(view(shape), world, filter);
}

}  // namespace abut
