#pragma once

// A textbook uniform hash grid, correct and slow: the baseline of every broad phase of the library.

#include <abut/math/aabb.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace abut::scenes {

/// Requires finite boxes, at most about 2^31 cells from the origin.
template <int D>
class PlainGrid {
public:
    /// The cell should be about as large as the larger boxes: smaller cells put a box into many cells, larger ones many
    /// boxes into a cell.
    explicit PlainGrid(float cell) : cell_(cell) {}

    void build(std::span<const Aabb<D>> boxes) {
        boxes_.assign(boxes.begin(), boxes.end());
        items_.clear();
        for (std::uint32_t item = 0; item < boxes_.size(); ++item)
            each_cell(boxes_[item], [&](const Cell& cell) { items_.emplace(cell, item); });
    }

    /// Calls visit(i, j) with i < j for every overlapping pair once, sorted. Two boxes may share several cells: the set
    /// removes duplicates.
    template <class Visit>
    void each_pair(Visit visit) const {
        std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
        for (std::uint32_t i = 0; i < boxes_.size(); ++i)
            each_cell(boxes_[i], [&](const Cell& cell) {
                const auto [begin, end] = items_.equal_range(cell);
                for (auto found = begin; found != end; ++found) {
                    const std::uint32_t j = found->second;
                    if (i < j && overlaps(boxes_[i], boxes_[j])) pairs.emplace(i, j);
                }
            });
        for (const auto& [i, j] : pairs) visit(i, j);
    }

private:
    using Cell = std::array<std::int32_t, D>;

    struct Hash {
        std::size_t operator()(const Cell& cell) const {
            std::size_t result = 0;
            for (const std::int32_t i : cell) result = (result ^ static_cast<std::uint32_t>(i)) * 0x9e3779b97f4a7c15u;
            return result ^ (result >> 32);
        }
    };

    /// Rounds down, also below zero: a conversion would merge the cells -1 and 0.
    std::int32_t cell_of(float coordinate) const { return static_cast<std::int32_t>(std::floor(coordinate / cell_)); }

    /// Calls visit(cell) for all cells that the box touches.
    template <class Visit>
    void each_cell(const Aabb<D>& box, Visit visit) const {
        Cell low, high;
        for (int i = 0; i < D; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            low[axis] = cell_of(box.min[i]);
            high[axis] = cell_of(box.max[i]);
            if (low[axis] > high[axis]) return;
        }
        for (Cell cell = low;;) {
            visit(std::as_const(cell));
            std::size_t axis = 0;
            while (axis < D && cell[axis] == high[axis]) {
                cell[axis] = low[axis];
                ++axis;
            }
            if (axis == D) return;
            ++cell[axis];
        }
    }

    float cell_;
    std::vector<Aabb<D>> boxes_;
    std::unordered_multimap<Cell, std::uint32_t, Hash> items_;
};

}  // namespace abut::scenes
