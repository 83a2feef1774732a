#pragma once

// The triangle: filled, in 3D of zero thickness, the same from both sides.

#include <abut/shape/given.hpp>

namespace abut {

template <int D>
struct Triangle {
    Vec<D> a{};
    Vec<D> b{};
    Vec<D> c{};
};
template <int D>
Triangle(glm::vec<D, float>, glm::vec<D, float>, glm::vec<D, float>) -> Triangle<D>;

using Triangle2 = Triangle<2>;
using Triangle3 = Triangle<3>;

template <int D>
Convex<D> convex(const Triangle<D>& triangle);
template <int D>
Convex<D> convex(const Triangle<D>& triangle, const Pose<D>& pose);
template <int D>
Given<D> given(const Triangle<D>& triangle) {
    return {ShapeKind::triangle, &triangle};
}

}  // namespace abut
