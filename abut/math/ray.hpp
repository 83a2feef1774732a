#pragma once

// Rays: directed line segments, possibly infinite.

#include <abut/math/vec.hpp>

#include <limits>

namespace abut {

template <int D>
struct Ray {
    Vec<D> origin{};
    Vec<D> direction{};                                     ///< unit vector; or 0 for a ray that is only its origin
    float length = std::numeric_limits<float>::infinity();  ///< length; may be infinite or zero

    /// The ray from a to b. If a == b it has length 0 and an arbitrary direction.
    static Ray between(const Vec<D>& a, const Vec<D>& b);
};
template <int D>
Ray(glm::vec<D, float>, glm::vec<D, float>, float) -> Ray<D>;

using Ray2 = Ray<2>;
using Ray3 = Ray<3>;

/// A ray with its origin in double, for a LargeWorld.
template <int D>
struct RayD {
    detail::DVec<D> origin{0.0};
    Vec<D> direction{};                                     ///< as that of a Ray
    float length = std::numeric_limits<float>::infinity();  ///< as that of a Ray

    /// The ray from a to b, with a direction and a length in float. If a == b it has length 0.
    static RayD between(const detail::DVec<D>& a, const detail::DVec<D>& b);
};
using RayD2 = RayD<2>;
using RayD3 = RayD<3>;

/// A moving box (swept AABB), in double. It has half extents `half`, and its center moves from `center` to `center +
/// direction * length`; the direction may have any length.
template <int D>
struct MovingBox {
    detail::DVec<D> center{0.0};
    detail::DVec<D> half{0.0};
    detail::DVec<D> direction{0.0};
    double length = 0;
};

extern template struct Ray<2>;
extern template struct Ray<3>;
extern template struct RayD<2>;
extern template struct RayD<3>;

}  // namespace abut
