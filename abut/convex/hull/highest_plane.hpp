#pragma once

// For each of many points, the plane that it is highest above.

#include <abut/math/detail/plane.hpp>

#include <cstddef>
#include <span>

namespace abut::detail {

/// Columns need this capacity beyond their points, which is read and written as well.
inline constexpr std::size_t highest_plane_padding = 8;

struct PointColumns {
    const double *x, *y, *z;
    std::size_t count;
};

/// One per point: the maximum of dot(normal, p) - offset over all planes, and the index of its plane, the first of
/// several. There is at least one plane. The result has the same bits on every SIMD target.
void highest_planes(std::span<const Plane<3>> planes, const PointColumns& points, double* heights, double* numbers);

}  // namespace abut::detail
