#pragma once

// Circle and sphere: all points within a distance of one.

#include <abut/shape/given.hpp>

namespace abut {

template <int D>
struct Ball {
    Vec<D> center{};
    float radius = 0;  ///< not below zero; zero is a point
};
template <int D>
Ball(glm::vec<D, float>, float) -> Ball<D>;

using Circle = Ball<2>;
using Sphere = Ball<3>;

template <int D>
Convex<D> convex(const Ball<D>& ball);
template <int D>
Convex<D> convex(const Ball<D>& ball, const Pose<D>& pose);
template <int D>
Given<D> given(const Ball<D>& ball) {
    return {ShapeKind::ball, &ball};
}

}  // namespace abut
