#pragma once

// A ray: a piece of a straight line, with a direction.

#include <abut/math/vec.hpp>

#include <limits>

namespace abut {

template <int D>
struct Ray {
    Vec<D> origin{};
    Vec<D> direction{};  ///< of length 1; or 0, of a ray that is its origin alone and hits only what contains that
    float length = std::numeric_limits<float>::infinity();  ///< how far it reaches; may be infinite or zero

    /// From a to b. Where a == b the ray has length 0 and some direction.
    static Ray between(const Vec<D>& a, const Vec<D>& b);
};
template <int D>
Ray(glm::vec<D, float>, glm::vec<D, float>, float) -> Ray<D>;

using Ray2 = Ray<2>;
using Ray3 = Ray<3>;

/// A box on its way, in double: it reaches `half` each way from its center, which moves from `center` along
/// `direction`, of any length, 0 to `length` times.
template <int D>
struct MovingBox {
    DVec<D> center{0.0};
    DVec<D> half{0.0};
    DVec<D> direction{0.0};
    double length = 0;
};

extern template struct Ray<2>;
extern template struct Ray<3>;

}  // namespace abut
