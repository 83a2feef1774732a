#pragma once

// Bounding boxes of balls and boxes at a pose, without making a view.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

namespace abut {

/// The bounding box, bit for bit that of the shape's view moved by the pose. It is empty if a number of the shape or
/// the pose is NaN or infinite.
template <int D>
Aabb<D> bounds_at(const Ball<D>& ball, const Pose<D>& pose);
template <int D>
Aabb<D> bounds_at(const Box<D>& box, const Pose<D>& pose);

}  // namespace abut
