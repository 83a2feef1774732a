#pragma once

// Circle and sphere.

#include <abut/shape/view/shape_ref.hpp>

namespace abut {

template <int D>
struct Ball {
    Vec<D> center{};
    float radius = 0;  ///< at least 0; 0 is a point
};
template <int D>
Ball(glm::vec<D, float>, float) -> Ball<D>;

using Circle = Ball<2>;
using Sphere = Ball<3>;

template <int D>
detail::Convex<D> convex(const Ball<D>& ball);
template <int D>
detail::Convex<D> convex(const Ball<D>& ball, const Pose<D>& pose);
template <int D>
detail::ShapeRef<D> shape_ref(const Ball<D>& ball) {
    return {detail::ShapeKind::ball, &ball};
}

}  // namespace abut
