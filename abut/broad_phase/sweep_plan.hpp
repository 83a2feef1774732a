#pragma once

// Along which axis SweepAndPrune sorts, and into how many columns it parts the space along the others. Not for users.

#include <abut/math/aabb.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut {

/// The axes in turn, so that `first` becomes axis 0.
template <int D, class T>
glm::vec<D, T> turned(const glm::vec<D, T>& v, int first) {
    glm::vec<D, T> result;
    for (int i = 0; i < D; ++i) result[i] = v[(first + i) % D];
    return result;
}
template <int D>
Aabb<D> turned(const Aabb<D>& box, int first) {
    return {turned<D>(box.min, first), turned<D>(box.max, first)};
}
/// Undoes `turned`.
template <int D>
Aabb<D> turned_back(const Aabb<D>& box, int first) {
    return turned<D>(box, (D - first) % D);
}

/// Equal parts of an axis between two places, at most 2^16; the outermost go on without end.
struct Parts {
    std::uint32_t count = 1;
    float low = 0, high = 0;  ///< finite
    float scale = 0;          ///< parts per length

    Parts() = default;
    Parts(std::uint32_t wanted, float from, float to);

    /// Of a larger number never a lower part.
    std::uint32_t at(float x) const {
        const float place = (std::clamp(x, low, high) - low) * scale;
        return std::min(static_cast<std::uint32_t>(static_cast<std::int32_t>(place)), count - 1);
    }
};

/// The columns of a box: some from the first on, and as many in some more rows of columns. In 2D each is a row.
struct ColumnSpan {
    std::uint32_t first = 0;
    std::uint32_t more_rows = 0, more = 0;  ///< below 2^16

    ColumnSpan(std::uint32_t first_column, std::uint32_t packed)
        : first(first_column), more_rows(packed >> 16), more(packed & 0xFFFF) {}
    std::uint32_t packed() const { return more_rows << 16 | more; }

    /// visit(column, bits of the axes on which the box began before it)
    template <class F>
    void each(std::uint32_t row, F&& visit) const {
        visit(first, 0u);
        if (packed() == 0) return;
        for (std::uint32_t k = 1; k <= more; ++k) visit(first + k, 1u << 30);
        for (std::uint32_t i = 1; i <= more_rows; ++i) {
            visit(first + i * row, 1u << 31);
            for (std::uint32_t k = 1; k <= more; ++k) visit(first + i * row + k, 3u << 30);
        }
    }
};

template <int D>
struct SweepPlan {
    int axis = 0;
    std::array<Parts, D - 1> parts;  ///< along the axes that follow

    std::uint32_t row() const { return D == 2 ? 1 : parts[D - 2].count; }
    ColumnSpan span(const Aabb<D>& turned_box) const {
        const std::uint32_t first = parts[0].at(turned_box.min[1]), last = parts[0].at(turned_box.max[1]);
        if constexpr (D == 2) return {first, (last - first) << 16};
        const std::uint32_t begin = parts[D - 2].at(turned_box.min[D - 1]),
                            end = parts[D - 2].at(turned_box.max[D - 1]);
        return {first * row() + begin, (last - first) << 16 | (end - begin)};
    }
    std::uint32_t columns() const {
        std::uint32_t result = 1;
        for (const Parts& p : parts) result *= p.count;
        return result;
    }
};

/// A measure of the time a box takes: to be copied into so many columns, and to be compared so often. Measured on
/// scenes of boxes that move; not exact, and the same everywhere.
inline double sweep_cost(double copies, double comparisons) {
    return 16 * copies + 0.3 * comparisons;
}

/// Looks at some of the boxes. No more than `most_columns`, and no more than `most_copies` a box by what is to be seen.
template <int D>
SweepPlan<D> plan_sweep(std::span<const Aabb<D>> boxes, std::size_t most_columns, double most_copies);

}  // namespace abut
