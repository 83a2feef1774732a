#pragma once

// The layout of the cells of a Grid. For .cpp files.

#include <abut/broad_phase/grid/packed_bounds.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace abut::detail {

/// A box with quantised coordinates. A cell has PackedBounds::steps steps along each axis.
template <int D>
struct QuantisedBox {
    std::array<std::uint32_t, D> low, high;
};

/// A range of cells; both ends are included.
template <int D>
struct CellRange {
    std::array<std::uint32_t, D> low, high;

    friend bool operator==(const CellRange&, const CellRange&) = default;
};

template <int D>
bool overlaps(const CellRange<D>& a, const CellRange<D>& b) {
    bool result = true;
    for (std::size_t i = 0; i < D; ++i) result = result && a.low[i] <= b.high[i] && b.low[i] <= a.high[i];
    return result;
}

/// The first cell that two ranges have in common. They must overlap.
template <int D>
std::array<std::uint32_t, D> first_cell(const CellRange<D>& a, const CellRange<D>& b) {
    std::array<std::uint32_t, D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = std::max(a.low[i], b.low[i]);
    return result;
}

/// A region of cubic cells. The cells at its border extend to infinity.
template <int D>
struct GridCells {
    std::array<float, D> origin{};
    float edge = 1;
    float scale = 1;              ///< steps per unit of length
    std::array<float, D> last{};  ///< the last step
    std::array<std::uint32_t, D> count{};
    std::array<std::uint32_t, D> stride{};
    std::uint32_t total = 0;

    /// Quantises a coordinate, monotonically.
    std::uint32_t step(float coordinate, std::size_t axis) const {
        const float position = (coordinate - origin[axis]) * scale;
        return static_cast<std::uint32_t>(std::min(std::max(position, 0.0f), last[axis]));
    }
    QuantisedBox<D> quantised(const Aabb<D>& box) const {
        QuantisedBox<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            result.low[i] = step(box.min[static_cast<int>(i)], i);
            result.high[i] = step(box.max[static_cast<int>(i)], i);
        }
        return result;
    }
    CellRange<D> range(const QuantisedBox<D>& box) const {
        CellRange<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            result.low[i] = box.low[i] >> PackedBounds<D>::step_bits;
            result.high[i] = box.high[i] >> PackedBounds<D>::step_bits;
        }
        return result;
    }
    CellRange<D> range(const Aabb<D>& box) const { return range(quantised(box)); }

    std::uint32_t index(const std::array<std::uint32_t, D>& cell) const {
        std::uint32_t result = 0;
        for (std::size_t i = 0; i < D; ++i) result += cell[i] * stride[i];
        return result;
    }
};

/// Visits the cells of a range, the first axis fastest, until the visitor returns false. Returns whether it never did.
template <int D, class Visit>
bool each_cell(const CellRange<D>& range, Visit visit) {
    std::array<std::uint32_t, D> cell = range.low;
    for (;;) {
        if (!visit(cell)) return false;
        std::size_t axis = 0;
        while (axis < D && cell[axis] == range.high[axis]) {
            cell[axis] = range.low[axis];
            ++axis;
        }
        if (axis == D) return true;
        ++cell[axis];
    }
}

/// The packed bounds of a box in one of the cells that it touches.
template <int D>
struct PackedBox {
    std::uint32_t low = 0, high = PackedBounds<D>::guards;

    PackedBox(const QuantisedBox<D>& box, const std::array<std::uint32_t, D>& cell) {
        using Packing = PackedBounds<D>;
        for (std::size_t i = 0; i < D; ++i) {
            const int axis = static_cast<int>(i);
            const std::uint32_t first = cell[i] << Packing::step_bits, beyond = first + Packing::steps;
            const bool is_copy = box.low[i] < first;
            low |= is_copy ? 1u << Packing::flag_shift[i] : Packing::field(box.low[i] - first, axis);
            high |= is_copy ? 0u : 1u << Packing::flag_shift[i];
            high |= Packing::field(std::min(box.high[i], beyond - 1) - first, axis);
        }
    }
};

}  // namespace abut::detail
