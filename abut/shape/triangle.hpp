#pragma once

// Triangle: filled; in 3D of zero thickness and two-sided.

#include <abut/shape/view/shape_ref.hpp>

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
detail::Convex<D> convex(const Triangle<D>& triangle);
template <int D>
detail::Convex<D> convex(const Triangle<D>& triangle, const Pose<D>& pose);
template <int D>
detail::ShapeRef<D> shape_ref(const Triangle<D>& triangle) {
    return {detail::ShapeKind::triangle, &triangle};
}

}  // namespace abut
