#pragma once

// Boxes: turned ones, and the axis-aligned ones of the broad phase as shapes.

#include <abut/shape/given.hpp>

namespace abut {

template <int D>
struct Box {
    Vec<D> center{};
    Vec<D> half{};                                          ///< half the length of each edge; not below zero
    Rotation<D> rotation = detail::identity_rotation<D>();  ///< about the center
};
template <int D>
Box(glm::vec<D, float>, glm::vec<D, float>) -> Box<D>;

using Box2 = Box<2>;
using Box3 = Box<3>;

template <int D>
Convex<D> convex(const Box<D>& box);
template <int D>
Convex<D> convex(const Box<D>& box, const Pose<D>& pose);
template <int D>
Given<D> given(const Box<D>& box) {
    return {ShapeKind::box, &box};
}

template <int D>
Convex<D> convex(const Aabb<D>& box);

}  // namespace abut
