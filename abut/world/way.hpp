#pragma once

// Where a shape comes to on its way from one pose to another, in boxes: what the broad phases need to know of a motion.

#include <abut/math/motion.hpp>
#include <abut/math/ray.hpp>
#include <abut/world/bounding_ball.hpp>

namespace abut {

/// A box around the shape, whatever rounding and the margin of doubt may add to it, that goes with the shape's position
/// and holds it however it turns on the way.
template <int D>
struct Way {
    Aabb<D> box = Aabb<D>::empty();  ///< at first
    Vec<D> move{};
};

/// Of a shape that moves without turning; `box` is around it at first.
template <int D>
Way<D> straight_way(const Aabb<D>& box, const Vec<D>& move);

/// `ball` is around the shape in its own frame, `box` around it at first.
template <int D>
Way<D> turning_way(const BoundingBall<D>& ball, const Aabb<D>& box, const Motion<D>& motion);

/// Around all of it.
template <int D>
Aabb<D> bounds(const Way<D>& way);

/// The way as another shape sees it that itself moves by `move_of_other`. Without bounds on some side where the way has
/// none.
template <int D>
MovingBox<D> moving_box(const Way<D>& way, const Vec<D>& move_of_other = Vec<D>(0.0f));

/// False only where the two surely don't meet.
template <int D>
bool may_meet(const Way<D>& a, const Way<D>& b);

}  // namespace abut
