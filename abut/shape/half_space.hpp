#pragma once

// Half-space: all points on one side of a line (2D) or plane (3D), such as the ground.

#include <abut/math/aabb.hpp>
#include <abut/math/affine.hpp>

namespace abut {

/// Solid where dot(normal, p) <= offset. Two half-spaces can't be queried as a pair.
template <int D>
struct HalfSpace {
    Vec<D> normal{};   ///< unit vector, out of the solid
    float offset = 0;  ///< signed distance of the plane from the origin, along the normal
};
template <int D>
HalfSpace(glm::vec<D, float>, float) -> HalfSpace<D>;

using HalfSpace2 = HalfSpace<2>;
using HalfSpace3 = HalfSpace<3>;

}  // namespace abut

namespace abut::detail {

/// The view of a half-space: placed in the world, in double.
template <int D>
struct HalfSpaceView {
    DVec<D> normal{0.0};  ///< of length 1
    double offset = 0;
};

template <int D>
HalfSpaceView<D> half_space_view(const HalfSpace<D>& half_space);

/// The half-space under an affine map.
template <int D>
HalfSpaceView<D> mapped(const HalfSpaceView<D>& view, const Affine<D>& map);

/// The half-space under a rigid map.
template <int D>
HalfSpaceView<D> moved(const HalfSpaceView<D>& view, const Affine<D>& rigid) {
    return mapped(view, rigid);
}

/// The half-space with its plane moved out by `radius`.
template <int D>
HalfSpaceView<D> rounded(const HalfSpaceView<D>& view, double radius);

/// The bounding box: infinite, except on the side of the plane if the normal is along an axis.
template <int D>
Aabb<D> bounds(const HalfSpaceView<D>& view);

}  // namespace abut::detail

namespace abut {

template <int D>
Aabb<D> bounds(const HalfSpace<D>& half_space) {
    return bounds(detail::half_space_view(half_space));
}

}  // namespace abut
