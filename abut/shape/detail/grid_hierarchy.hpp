#pragma once

// Hierarchy over the cells of a 2D grid, with a branching factor of 4 x 4: each level summarises 4 x 4 blocks of the
// level below, and the top level is one block. Searches traverse it like a tree. For .cpp files.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/aabb.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace abut::detail {

/// `Summary` holds what is known of a block. Its default is that of an empty block; `merged(a, b)` combines two.
template <class Summary>
class GridHierarchy {
public:
    /// Builds the levels from `summary_of(column, row)` of each cell. There is at least one cell.
    template <class CellSummary>
    void build(std::uint32_t columns, std::uint32_t rows, CellSummary&& summary_of) {
        cells_ = {columns, rows, 0};
        levels_.clear();
        std::size_t count = 0;
        for (Level last = cells_; levels_.empty() || last.columns > 1 || last.rows > 1;) {
            last = {(last.columns - 1) / side + 1, (last.rows - 1) / side + 1, count};
            count += last.size();
            levels_.push_back(last);
        }
        summaries_.resize(count);
        update({0, 0}, {columns, rows}, summary_of);
    }

    /// Brings the levels up to date where the summaries of some cells have changed: those from `first` to the one
    /// before `end`, in columns and rows.
    template <class CellSummary>
    void update(glm::uvec2 first, glm::uvec2 end, CellSummary&& summary_of) {
        Level below = cells_;
        for (std::uint32_t level = 1; level <= levels_.size(); below = level_of(level++)) {
            first /= side;
            end = (end - 1u) / side + 1u;
            for (std::uint32_t y = first.y; y < end.y; ++y)
                for (std::uint32_t x = first.x; x < end.x; ++x) {
                    Summary summary;
                    for (std::uint32_t j = side * y; j < std::min(below.rows, side * (y + 1)); ++j)
                        for (std::uint32_t i = side * x; i < std::min(below.columns, side * (x + 1)); ++i)
                            summary = merged(summary, level == 1 ? summary_of(i, j) : at(level - 1, i, j));
                    const Level& of = level_of(level);
                    summaries_[of.first + std::size_t{y} * of.columns + x] = summary;
                }
        }
    }

    /// The summary of a block. Levels count from 1.
    const Summary& at(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
        const Level& of = level_of(level);
        return summaries_[of.first + std::size_t{y} * of.columns + x];
    }
    const Summary& all() const { return summaries_.back(); }

    /// The first cell of a block along an axis.
    std::uint32_t first_column(std::uint32_t level, std::uint32_t x) const { return first(level, x, cells_.columns); }
    std::uint32_t first_row(std::uint32_t level, std::uint32_t y) const { return first(level, y, cells_.rows); }

    std::size_t bytes() const { return summaries_.size() * sizeof(Summary); }

    /// Calls visit(column, row) for the cells within reach, a RayReach or BoxReach, nearest first among the children of
    /// a block. `box_of(level, x, y)` is the box of a block, or of a cell at level 0; an empty box is skipped. `visit`
    /// shrinks the reach.
    template <class Reach, class BoxOf, class Visit>
    void traverse(const Reach& reach, BoxOf&& box_of, Visit&& visit) const {
        std::array<StackEntry, max_stack> stack;
        std::size_t stack_size = 0;
        const auto push = [&](std::uint32_t level, std::uint32_t x, std::uint32_t y, std::size_t bottom) {
            const auto box = box_of(level, x, y);
            double measure = 0;
            if (is_empty(box) || !reach.measure(box, measure)) return;
            std::size_t place = stack_size++;
            for (; place > bottom && stack[place - 1].measure < measure; --place) stack[place] = stack[place - 1];
            stack[place] = {measure, level, x, y};
        };
        push(static_cast<std::uint32_t>(levels_.size()), 0, 0, 0);
        while (stack_size > 0 && !reach.is_exhausted()) {
            const StackEntry next = stack[--stack_size];
            if (!reach.within(next.measure)) continue;
            if (next.level == 0) {
                visit(next.x, next.y);
                continue;
            }
            const Level& below = next.level == 1 ? cells_ : level_of(next.level - 1);
            const std::uint32_t end_x = std::min(below.columns, (next.x + 1) * side),
                                end_y = std::min(below.rows, (next.y + 1) * side);
            const std::size_t bottom = stack_size;
            for (std::uint32_t y = next.y * side; y < end_y; ++y)
                for (std::uint32_t x = next.x * side; x < end_x; ++x) push(next.level - 1, x, y, bottom);
        }
    }

private:
    static constexpr std::uint32_t side = 4;
    /// 2^32 cells along an axis make 16 levels; each level leaves at most 15 children on the stack.
    static constexpr std::size_t max_stack = 16 * (side * side - 1) + 1;

    struct Level {
        std::uint32_t columns = 0, rows = 0;
        std::size_t first = 0;  ///< index of its first summary

        std::size_t size() const { return std::size_t{columns} * rows; }
    };
    struct StackEntry {
        double measure;
        std::uint32_t level, x, y;
    };

    const Level& level_of(std::uint32_t level) const { return levels_[level - 1]; }

    static std::uint32_t first(std::uint32_t level, std::uint32_t i, std::uint32_t count) {
        std::uint64_t result = i;
        for (; level > 0; --level) result *= side;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(result, count));
    }

    Level cells_;
    std::vector<Level> levels_;
    std::vector<Summary> summaries_;
};

/// The range [begin, end) of cells along an axis that a box may overlap, padded by one cell on each side against
/// rounding.
struct CellRange {
    std::uint32_t begin = 0, end = 0;

    CellRange(float min, float max, float cell, std::uint32_t count)
        : begin(index(min, cell, -1.0, count)), end(index(max, cell, 2.0, count)) {}
    std::uint32_t size() const { return end > begin ? end - begin : 0; }

private:
    static std::uint32_t index(float at, float cell, double extra, std::uint32_t count) {
        const double place = std::floor(static_cast<double>(at) / static_cast<double>(cell)) + extra;
        return place > 0 ? static_cast<std::uint32_t>(std::min(place, static_cast<double>(count))) : 0;
    }
};

}  // namespace abut::detail
