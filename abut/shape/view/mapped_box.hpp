#pragma once

// The bounding box of a mapped box. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/affine.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {

/// The box that contains everything.
template <int D>
Aabb<D> everywhere() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {Vec<D>(-infinity), Vec<D>(infinity)};
}

/// The box of a box under an affine map, rounded outwards.
template <int D>
Aabb<D> mapped_box(const Aabb<D>& box, const Affine<D>& map) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        double low = map.offset[i], high = map.offset[i];
        for (int j = 0; j < D; ++j) {
            const double factor = map.column[static_cast<std::size_t>(j)][i];
            if (factor == 0) continue;
            const double a = factor * static_cast<double>(box.min[j]), b = factor * static_cast<double>(box.max[j]);
            low += std::min(a, b);
            high += std::max(a, b);
        }
        result.min[i] = next_down(static_cast<float>(low));
        result.max[i] = next_up(static_cast<float>(high));
    }
    return result;
}

}  // namespace abut::detail
