#pragma once

// Bounding balls of shapes: shapes are apart if their balls are.

#include <abut/convex/bounding_ball.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// A ball that contains a shape, with a margin for rounding. The radius is infinite or NaN if no such ball exists. The
/// ball of a composite shape, or of one with a user's support function, contains its AABB.
template <int D>
BoundingBall<D> bounding_ball(const View<D>& view);

/// A ball in floats that contains a ball in doubles; infinite if that is.
template <int D>
struct SmallBall {
    Vec<D> center{};
    float radius = 0;

    static SmallBall around(const BoundingBall<D>& ball);
    BoundingBall<D> ball() const { return {DVec<D>(center), static_cast<double>(radius)}; }
};

/// The margin of a ball for its position, many times the rounding errors in double.
inline constexpr double position_margin = 1e-12;

/// The ball of a shape that `pose` translates and rotates, from the ball of the shape in its own frame.
template <int D>
BoundingBall<D> moved(const BoundingBall<D>& ball, const Affine<D>& pose) {
    const double reach = largest(ball.center) + largest(pose.offset);
    return {pose.point(ball.center), ball.radius + 2 * reach * position_margin};
}

/// Whether the balls are apart. The shapes in them are then apart by more than the error of any query.
template <int D>
bool apart(const BoundingBall<D>& a, const BoundingBall<D>& b) {
    const double reach = a.radius + b.radius;
    return length_squared(b.center - a.center) > reach * reach;
}

}  // namespace abut::detail
