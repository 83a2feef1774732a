#pragma once

// The boxes of plain shapes at a pose, without a view.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

namespace abut {

/// The same box, to the bit, as that of the shape's view moved by the pose; empty where a number of either is NaN or
/// infinite.
template <int D>
Aabb<D> bounds_at(const Ball<D>& ball, const Pose<D>& pose);
template <int D>
Aabb<D> bounds_at(const Box<D>& box, const Pose<D>& pose);

}  // namespace abut
