#pragma once

// Capsule: all points within `radius` of a segment.

#include <abut/shape/view/shape_ref.hpp>

namespace abut {

template <int D>
struct Capsule {
    Vec<D> a{};
    Vec<D> b{};
    float radius = 0;  ///< not below zero
};
template <int D>
Capsule(glm::vec<D, float>, glm::vec<D, float>, float) -> Capsule<D>;

using Capsule2 = Capsule<2>;
using Capsule3 = Capsule<3>;

template <int D>
detail::Convex<D> convex(const Capsule<D>& capsule);
template <int D>
detail::Convex<D> convex(const Capsule<D>& capsule, const Pose<D>& pose);
template <int D>
detail::ShapeRef<D> shape_ref(const Capsule<D>& capsule) {
    return {detail::ShapeKind::capsule, &capsule};
}

}  // namespace abut
