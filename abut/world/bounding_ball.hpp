#pragma once

// Balls around shapes: where two balls are apart, so are the shapes in them.

#include <abut/convex/bounding_ball.hpp>
#include <abut/shape/view/view.hpp>

namespace abut {

/// Holds a shape, with room for rounding; the radius is infinite or NaN where there is no such ball. About the middle
/// of a convex core's box; of a composite shape or a user's own, the one around its box.
template <int D>
BoundingBall<D> bounding_ball(const View<D>& view);

/// A ball in floats that holds another one; infinite where that is.
template <int D>
struct SmallBall {
    Vec<D> center{};
    float radius = 0;

    static SmallBall around(const BoundingBall<D>& ball);
    BoundingBall<D> ball() const { return {DVec<D>(center), static_cast<double>(radius)}; }
};

/// The same ball for the shape moved and turned by `pose`.
template <int D>
BoundingBall<D> moved(const BoundingBall<D>& ball, const Affine<D>& pose);

/// True only where the shapes in the balls are apart, by more than an answer about them can be wrong by.
template <int D>
bool apart(const BoundingBall<D>& a, const BoundingBall<D>& b);

}  // namespace abut
