#pragma once

// Boxes as a structure of arrays (SoA), one array for each bound. For .cpp files.

#include <abut/math/aabb.hpp>

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace abut::detail {

/// Box i has the bounds min[axis][i], max[axis][i].
template <int D>
struct BoxSoaView {
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

/// A box of NaNs overlaps nothing: every comparison with its bounds is false.
template <int D>
Aabb<D> nan_box() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    return {Vec<D>(nan), Vec<D>(nan)};
}

/// SIMD code may read this many numbers from the place of any box on. The arrays are padded for it.
inline constexpr std::size_t box_lanes = 16;

template <int D>
class BoxSoa {
public:
    /// Sets the capacity to at least `count` boxes. If it has to grow, the contents are lost.
    void reserve(std::size_t count) {
        if (count <= capacity_) return;
        capacity_ = count;
        // The stride is an odd number of cache lines, or else the arrays compete for the same sets of the cache.
        const std::size_t lines = (count + box_lanes - 1) / box_lanes + 1;
        stride_ = (lines | 1) * box_lanes;
        numbers_.assign(2 * D * stride_, std::numeric_limits<float>::quiet_NaN());
    }
    std::size_t capacity() const { return capacity_; }
    /// Sets the capacity to at least `count` boxes and preserves the first `size` boxes.
    void grow(std::size_t count, std::size_t size) {
        BoxSoa larger;
        larger.reserve(count);
        const BoxSoaView<D> boxes = view();
        for (std::size_t i = 0; i < size; ++i) larger.set(i, boxes[i]);
        *this = std::move(larger);
    }

    void set(std::size_t i, const Aabb<D>& box) {
        float* number = numbers_.data() + i;
        for (int axis = 0; axis < D; ++axis, number += 2 * stride_) {
            number[0] = box.min[axis];
            number[stride_] = box.max[axis];
        }
    }

    /// The boxes from `first` on.
    BoxSoaView<D> view(std::size_t first = 0) const {
        BoxSoaView<D> result;
        for (std::size_t axis = 0; axis < D; ++axis) {
            result.min[axis] = numbers_.data() + 2 * axis * stride_ + first;
            result.max[axis] = result.min[axis] + stride_;
        }
        return result;
    }

private:
    std::size_t capacity_ = 0, stride_ = 0;
    std::vector<float> numbers_;
};

}  // namespace abut::detail
