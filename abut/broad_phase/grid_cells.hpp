#pragma once

// Where the cells of a Grid are. For .cpp files.

#include <abut/broad_phase/grid_words.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace abut {

/// The places that a box takes up along each axis: steps, of which a cell has GridWords::steps.
template <int D>
struct GridSteps {
    std::array<std::uint32_t, D> low, high;
};

/// Cells from and to, both included.
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

/// The first cell that two ranges have in common, where they have any.
template <int D>
std::array<std::uint32_t, D> first_cell(const CellRange<D>& a, const CellRange<D>& b) {
    std::array<std::uint32_t, D> result;
    for (std::size_t i = 0; i < D; ++i) result[i] = std::max(a.low[i], b.low[i]);
    return result;
}

/// A block of cubic cells. What lies outside belongs to the cells at the border, which have no end there.
template <int D>
struct GridCells {
    std::array<float, D> origin{};
    float edge = 1;
    float scale = 1;              ///< steps a length
    std::array<float, D> last{};  ///< the last step
    std::array<std::uint32_t, D> count{};
    std::array<std::uint32_t, D> stride{};
    std::uint32_t total = 0;

    /// Larger coordinates have larger steps, or the same.
    std::uint32_t step(float coordinate, std::size_t axis) const {
        const float place = (coordinate - origin[axis]) * scale;
        return static_cast<std::uint32_t>(std::min(std::max(place, 0.0f), last[axis]));
    }
    GridSteps<D> steps(const Aabb<D>& box) const {
        GridSteps<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            result.low[i] = step(box.min[static_cast<int>(i)], i);
            result.high[i] = step(box.max[static_cast<int>(i)], i);
        }
        return result;
    }
    CellRange<D> range(const GridSteps<D>& steps) const {
        CellRange<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            result.low[i] = steps.low[i] >> GridWords<D>::step_bits;
            result.high[i] = steps.high[i] >> GridWords<D>::step_bits;
        }
        return result;
    }
    CellRange<D> range(const Aabb<D>& box) const { return range(steps(box)); }

    std::uint32_t index(const std::array<std::uint32_t, D>& cell) const {
        std::uint32_t result = 0;
        for (std::size_t i = 0; i < D; ++i) result += cell[i] * stride[i];
        return result;
    }
};

/// Visits the cells of a range, the first axis fastest, until one says false. Returns whether none did.
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

/// The words of a box in one of the cells that it touches.
template <int D>
struct WordsInCell {
    std::uint32_t low = 0, high = GridWords<D>::guards;

    WordsInCell(const GridSteps<D>& steps, const std::array<std::uint32_t, D>& cell) {
        using Words = GridWords<D>;
        for (std::size_t i = 0; i < D; ++i) {
            const int axis = static_cast<int>(i);
            const std::uint32_t first = cell[i] << Words::step_bits, beyond = first + Words::steps;
            const bool guest = steps.low[i] < first;
            low |= guest ? 1u << Words::flag_shift[i] : Words::field(steps.low[i] - first, axis);
            high |= guest ? 0u : 1u << Words::flag_shift[i];
            high |= Words::field(std::min(steps.high[i], beyond - 1) - first, axis);
        }
    }
};

}  // namespace abut
