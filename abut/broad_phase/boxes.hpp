#pragma once

// Boxes in the form that the broad phases store. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/assert.hpp>

#include <cmath>

namespace abut::detail {

/// Returns the box itself, or Aabb::empty() if it is empty or has a NaN. A NaN trips ABUT_ASSERT.
template <int D>
Aabb<D> usable(const Aabb<D>& box) {
    bool result = true;
    for (int i = 0; i < D; ++i) {
        ABUT_ASSERT(!std::isnan(box.min[i]) && !std::isnan(box.max[i]));
        result = result && box.min[i] <= box.max[i];
    }
    return result ? box : Aabb<D>::empty();
}

/// Requires a box from `usable`.
template <int D>
bool is_empty(const Aabb<D>& box) {
    return !(box.min[0] <= box.max[0]);
}

}  // namespace abut::detail
