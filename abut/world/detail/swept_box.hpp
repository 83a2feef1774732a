#pragma once

// Swept boxes: bounds of a shape during its motion from one pose to another, for the broad phases.

#include <abut/math/motion.hpp>
#include <abut/math/ray.hpp>
#include <abut/world/detail/bounding_ball.hpp>

namespace abut::detail {

/// A box that moves linearly with a shape's position and contains it at every rotation during the motion. The tolerance
/// of a sweep and rounding are included.
template <int D>
struct SweptBox {
    Aabb<D> box = Aabb<D>::empty();  ///< at the start of the motion
    Vec<D> move{};                   ///< the translation of the whole motion
};

/// The swept box of a linear motion; `box` contains the shape at the start.
template <int D>
SweptBox<D> swept_box(const Aabb<D>& box, const Vec<D>& move);

/// The swept box of a motion with rotation. `ball` contains the shape in its own frame, `box` contains it at the start.
template <int D>
SweptBox<D> swept_box(const BoundingBall<D>& ball, const Aabb<D>& box, const Motion<D>& motion);

/// The swept AABB: it contains the whole path.
template <int D>
Aabb<D> bounds(const SweptBox<D>& path);

/// The moving box relative to another shape that moves by `move_of_other`. It is unbounded on the sides on which the
/// swept box is.
template <int D>
MovingBox<D> moving_box(const SweptBox<D>& path, const Vec<D>& move_of_other = Vec<D>(0.0f));

/// False if the two boxes do not overlap at any time; true if they may.
template <int D>
bool may_overlap(const SweptBox<D>& a, const SweptBox<D>& b);

}  // namespace abut::detail
