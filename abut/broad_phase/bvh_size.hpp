#pragma once

// What a node costs. For .cpp files.

#include <abut/math/vec.hpp>

#include <algorithm>
#include <limits>

namespace abut {

/// Half the surface of a box in 3D, half the outline in 2D. The box is neither empty nor without bound.
template <class Box>
double half_area(const Box& box) {
    constexpr int dimension = decltype(box.min)::length();
    double extent[dimension];
    for (int i = 0; i < dimension; ++i) extent[i] = static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
    if constexpr (dimension == 2)
        return extent[0] + extent[1];
    else
        return extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
}

/// Half the surface of a box in 3D, half the outline in 2D.
struct BoxSize {
    double area = 0;
    bool endless = false;  ///< without bound on some axis; that axis counts as none, for no tree can do better there
};

template <class Box>
BoxSize box_size(const Box& box) {
    BoxSize result;
    constexpr int dimension = decltype(box.min)::length();
    double extent[dimension];
    for (int i = 0; i < dimension; ++i) {
        extent[i] = static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
        result.endless = result.endless || extent[i] == std::numeric_limits<double>::infinity();
        if (!(extent[i] >= 0 && extent[i] < std::numeric_limits<double>::infinity())) extent[i] = 0;
    }
    if constexpr (dimension == 2)
        result.area = extent[0] + extent[1];
    else
        result.area = extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
    return result;
}

}  // namespace abut
