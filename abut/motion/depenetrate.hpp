#pragma once

// How does a shape get out of what it is in?

#include <abut/world/world.hpp>

namespace abut {

template <int D>
struct Depenetration {
    Vec<D> push{};    ///< to be added to the shape's position
    float depth = 0;  ///< in the deepest place after the push; 0: it is free

    /// Whether it gets out.
    explicit operator bool() const { return depth == 0; }
};

template <int D>
Depenetration<D> depenetrate_convex(const Convex<D>& shape, const World<D>& world, const Filter& filter);

/// The push that takes a convex shape out of all that it is in, by pushes each of which is the least one that leaves
/// all planes of contact at once; the sum is short, and need not be the shortest. Where it comes to something else on
/// the way, it stops there, and goes on from there; after twelve it gives up and tells the depth that is left. A shape
/// that is free stays where it is; one that isn't ends 1e-4 of its size from what it was in. Allocates; Mover doesn't.
template <Shape S>
requires(detail::is_convex_view<detail::ViewOf<S>>) Depenetration<dimension<S>> depenetrate(
    const S& shape, const World<dimension<S>>& world, const Filter& filter = {}) {
    return depenetrate_convex<dimension<S>>(view(shape), world, filter);
}

}  // namespace abut
