#pragma once

// Line segment between two points.

#include <abut/shape/view/shape_ref.hpp>

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
detail::Convex<D> convex(const Segment<D>& segment);
template <int D>
detail::Convex<D> convex(const Segment<D>& segment, const Pose<D>& pose);
template <int D>
detail::ShapeRef<D> shape_ref(const Segment<D>& segment) {
    return {detail::ShapeKind::segment, &segment};
}

}  // namespace abut
