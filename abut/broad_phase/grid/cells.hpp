#pragma once

// The layout of the cells of a Grid. For .cpp files.

#include <abut/math/aabb.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace abut::detail {

/// A word has a field and a flag for each axis. The field of the low word is the lower bound of the box in steps from
/// the low side of the cell; the field of the high word is the upper bound. Bounds beyond the cell are clamped to it. A
/// guard bit above every field is 1 in high words and 0 in low words. After a subtraction the guard bit is still 1 if
/// the field of the high word was not smaller. So two boxes overlap if all guard bits are set in both `high of b - low
/// of a` and `high of a - low of b`.
///
/// The home cell of a box along an axis is the cell that contains its lower bound; in later cells the box is a copy.
/// The low word has the flag of an axis if the box is a copy, the high word if the cell is its home. If both boxes are
/// copies, the subtraction clears the guard bit of the flag: an earlier cell reports the pair.
template <int D>
struct PackedBounds {
    static constexpr int field_bits[3] = {D == 2 ? 13 : 8, D == 2 ? 13 : 8, 7};
    static constexpr int field_shift[3] = {0, field_bits[0] + 1, field_bits[0] + field_bits[1] + 2};
    static constexpr int flag_shift[3] = {32 - 2 * D, 34 - 2 * D, 36 - 2 * D};
    static_assert(field_shift[D - 1] + field_bits[D - 1] + 1 == flag_shift[0]);

    /// The number of steps of a cell along each axis. The fields hold the upper bits of a step.
    static constexpr int step_bits = field_bits[0];
    static constexpr std::uint32_t steps = 1u << step_bits;

    static constexpr std::uint32_t max_field(int axis) { return (1u << field_bits[axis]) - 1; }
    static constexpr std::uint32_t field(std::uint32_t step, int axis) {
        return step >> (step_bits - field_bits[axis]) << field_shift[axis];
    }

    /// All bits of the fields of the axes whose bits are set in `axes`.
    static constexpr std::uint32_t fields(std::uint32_t axes) {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i)
            if ((axes >> i & 1) != 0) result |= max_field(i) << field_shift[i];
        return result;
    }
    static constexpr std::uint32_t flags(std::uint32_t axes) {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i) result |= (axes >> i & 1) << flag_shift[i];
        return result;
    }

    static constexpr std::uint32_t all_axes = (1u << D) - 1;
    static constexpr std::uint32_t all_guards() {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i) result |= 1u << (field_shift[i] + field_bits[i]) | 2u << flag_shift[i];
        return result;
    }
    static constexpr std::uint32_t all_ones() {
        std::uint32_t result = 0;
        for (int i = 0; i < D; ++i) result |= 1u << field_shift[i];
        return result;
    }
    static constexpr std::uint32_t guards = all_guards();
    static constexpr std::uint32_t ones = all_ones();

    /// Whether the steps alone prove that two boxes overlap, given that their steps overlap: no two steps are equal.
    static bool surely_overlap(std::uint32_t low_a, std::uint32_t high_a, std::uint32_t low_b, std::uint32_t high_b) {
        return ((high_b - low_a - ones) & (high_a - low_b - ones) & guards) == guards;
    }
};

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
