#pragma once

// The sides of a box as plain rows of numbers. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace abut {

/// An Aabb for loops that have to be quick: glm chooses an axis by a switch, which compilers keep.
template <int D>
struct BoxSides {
    float min[D], max[D];

    static BoxSides of(const Aabb<D>& box) { return std::bit_cast<BoxSides>(box); }
    Aabb<D> box() const { return std::bit_cast<Aabb<D>>(*this); }

    /// False also of a box with a NaN.
    bool holds_something() const {
        bool result = true;
        for (int i = 0; i < D; ++i) {
            ABUT_ASSERT(!std::isnan(min[i]) && !std::isnan(max[i]));
            result = result & (min[i] <= max[i]);
        }
        return result;
    }
    void take_in(const BoxSides& other) {
        for (int i = 0; i < D; ++i) {
            min[i] = std::min(min[i], other.min[i]);
            max[i] = std::max(max[i], other.max[i]);
        }
    }
    /// Of boxes that are not empty. Counts, for a branch on every side would cost more.
    bool meets(const BoxSides& other) const {
        int apart = 0;
        for (int i = 0; i < D; ++i)
            apart += static_cast<int>(min[i] > other.max[i]) + static_cast<int>(other.min[i] > max[i]);
        return apart == 0;
    }
};

}  // namespace abut
