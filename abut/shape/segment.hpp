#pragma once

// The straight piece between two points.

#include <abut/shape/given.hpp>

namespace abut {

template <int D>
struct Segment {
    Vec<D> a{};
    Vec<D> b{};
};
template <int D>
Segment(glm::vec<D, float>, glm::vec<D, float>) -> Segment<D>;

using Segment2 = Segment<2>;
using Segment3 = Segment<3>;

template <int D>
Convex<D> convex(const Segment<D>& segment);
template <int D>
Convex<D> convex(const Segment<D>& segment, const Pose<D>& pose);
template <int D>
Given<D> given(const Segment<D>& segment) {
    return {ShapeKind::segment, &segment};
}

}  // namespace abut
