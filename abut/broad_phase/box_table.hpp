#pragma once

// Boxes by rows of numbers, one for each bound: the layout that vector units like. For .cpp files.

#include <abut/math/aabb.hpp>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace abut {

/// Box i has the bounds min[axis][i], max[axis][i].
template <int D>
struct BoxRows {
    const float* min[D];
    const float* max[D];

    Aabb<D> operator[](std::size_t i) const {
        Aabb<D> result;
        for (int axis = 0; axis < D; ++axis) {
            result.min[axis] = min[axis][i];
            result.max[axis] = max[axis][i];
        }
        return result;
    }
};

/// A box of NaNs: overlaps nothing, and ends every comparison of bounds.
template <int D>
Aabb<D> no_box() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    return {Vec<D>(nan), Vec<D>(nan)};
}

/// Some boxes, and room behind them: `box_lanes` numbers may be read from the place of any box.
inline constexpr std::size_t box_lanes = 16;

template <int D>
class BoxTable {
public:
    /// Room for so many boxes. What was in the table is lost where there was less.
    void reserve(std::size_t count) {
        if (count <= room_) return;
        room_ = count;
        // An odd number of cache lines, or the rows would compete for the same places of the cache.
        const std::size_t lines = (count + box_lanes - 1) / box_lanes + 1;
        stride_ = (lines | 1) * box_lanes;
        numbers_.assign(2 * D * stride_, std::numeric_limits<float>::quiet_NaN());
    }
    std::size_t room() const { return room_; }
    /// The same, and the first `kept` boxes stay.
    void grow(std::size_t count, std::size_t kept) {
        BoxTable larger;
        larger.reserve(count);
        const BoxRows<D> boxes = rows();
        for (std::size_t i = 0; i < kept; ++i) larger.set(i, boxes[i]);
        *this = std::move(larger);
    }

    void set(std::size_t i, const Aabb<D>& box) {
        float* number = numbers_.data() + i;
        for (int axis = 0; axis < D; ++axis, number += 2 * stride_) {
            number[0] = box.min[axis];
            number[stride_] = box.max[axis];
        }
    }

    /// From some box on.
    BoxRows<D> rows(std::size_t first = 0) const {
        BoxRows<D> result;
        for (std::size_t axis = 0; axis < D; ++axis) {
            result.min[axis] = numbers_.data() + 2 * axis * stride_ + first;
            result.max[axis] = result.min[axis] + stride_;
        }
        return result;
    }

private:
    std::size_t room_ = 0, stride_ = 0;
    std::vector<float> numbers_;
};

}  // namespace abut
