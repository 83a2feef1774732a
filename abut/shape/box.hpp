#pragma once

// Oriented boxes, and the axis-aligned boxes of the broad phase as shapes.

#include <abut/shape/view/shape_ref.hpp>

namespace abut {

template <int D>
struct Box {
    Vec<D> center{};
    Vec<D> half{};                                          ///< half the length of each edge; at least 0
    Rotation<D> rotation = detail::identity_rotation<D>();  ///< about the center
};
template <int D>
Box(glm::vec<D, float>, glm::vec<D, float>) -> Box<D>;

using Box2 = Box<2>;
using Box3 = Box<3>;

template <int D>
detail::Convex<D> convex(const Box<D>& box);
template <int D>
detail::Convex<D> convex(const Box<D>& box, const Pose<D>& pose);
template <int D>
detail::ShapeRef<D> shape_ref(const Box<D>& box) {
    return {detail::ShapeKind::box, &box};
}

template <int D>
detail::Convex<D> convex(const Aabb<D>& box);

}  // namespace abut
