#pragma once

// The surface areas of boxes, for the costs of nodes. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {

/// Half the surface area of a box in 3D, half its perimeter in 2D.
struct BoxSize {
    double area = 0;
    bool is_unbounded = false;  ///< on some axis; that axis counts as 0, for no tree can separate boxes along it
};

template <class Box>
BoxSize box_size(const Box& box) {
    BoxSize result;
    constexpr int dimension = decltype(box.min)::length();
    double extent[dimension];
    for (int i = 0; i < dimension; ++i) {
        extent[i] = static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
        result.is_unbounded = result.is_unbounded || extent[i] == std::numeric_limits<double>::infinity();
        if (!(extent[i] >= 0 && extent[i] < std::numeric_limits<double>::infinity())) extent[i] = 0;
    }
    if constexpr (dimension == 2)
        result.area = extent[0] + extent[1];
    else
        result.area = extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
    return result;
}

/// False if a coordinate is beyond 1e37, so that sums of floats could overflow.
template <int D>
bool is_bounded(const Aabb<D>& box) {
    constexpr float far = 1e37f;
    for (int i = 0; i < D; ++i)
        if (box.min[i] < -far || box.max[i] > far) return false;
    return true;
}

}  // namespace abut::detail
