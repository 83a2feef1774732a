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

/// A short push that takes a convex shape out of all that it is in. It is looked for along lines: out of each part, out
/// of all at once, and evenly all around; and from where a line is free, by sliding back towards the start. Beside all
/// ways there are, in the plane and out of up to eight convex parts that overlap one another, it is the shortest in 97
/// %, by 2 %. What lies between here and there is not in its way.
///
/// A shape that is free stays where it is; one that isn't ends 1e-4 of its size from what it was in. Where no line
/// leaves what it is in, such as between two half-spaces, or none within 256 parts, it stays, and the depth tells how
/// far it is in the deepest. Allocates nothing.
template <Shape S>
requires(detail::is_convex_view<detail::ViewOf<S>>) Depenetration<dimension<S>> depenetrate(
    const S& shape, const World<dimension<S>>& world, const Filter& filter = {}) {
    return depenetrate_convex<dimension<S>>(view(shape), world, filter);
}

}  // namespace abut
