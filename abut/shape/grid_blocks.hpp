#pragma once

// Blocks over the cells of a grid of the plane: of 4 x 4 cells, of 4 x 4 such blocks, and so on up to one that holds
// all; each knows in short what is in it. Searches go through them as through a tree. For .cpp files.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/aabb.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// `Summary` is what a block knows: by default that there is nothing in it, and `merged(a, b)` is that of both.
template <class Summary>
class GridBlocks {
public:
    /// Of each cell it is `of_cell(column, row)`. There is at least one cell.
    template <class OfCell>
    void build(std::uint32_t columns, std::uint32_t rows, OfCell&& of_cell) {
        cells_ = {columns, rows, 0};
        levels_.clear();
        std::size_t count = 0;
        for (Level last = cells_; levels_.empty() || last.columns > 1 || last.rows > 1;) {
            last = {(last.columns - 1) / side + 1, (last.rows - 1) / side + 1, count};
            count += last.size();
            levels_.push_back(last);
        }
        summaries_.assign(count, Summary());
        for (std::uint32_t y = 0; y < rows; ++y)
            for (std::uint32_t x = 0; x < columns; ++x) add(1, x, y, of_cell(x, y));
        for (std::uint32_t level = 2; level <= levels_.size(); ++level) {
            const Level& below = level_of(level - 1);
            for (std::uint32_t y = 0; y < below.rows; ++y)
                for (std::uint32_t x = 0; x < below.columns; ++x) add(level, x, y, at(level - 1, x, y));
        }
    }

    /// Of a block of a level, the first of which is 1.
    const Summary& at(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
        const Level& of = level_of(level);
        return summaries_[of.first + std::size_t{y} * of.columns + x];
    }
    const Summary& all() const { return summaries_.back(); }

    /// The cells along an axis, from the first of a block to before the last.
    std::uint32_t first_column(std::uint32_t level, std::uint32_t x) const { return first(level, x, cells_.columns); }
    std::uint32_t first_row(std::uint32_t level, std::uint32_t y) const { return first(level, y, cells_.rows); }

    std::size_t bytes() const { return summaries_.size() * sizeof(Summary); }

    /// visit(column, row) for the cells that are within reach, a RayReach or BoxReach; of two blocks, the nearer first.
    /// `box_of(level, x, y)` is the box of a block, or at level 0 of a cell; empty where there is nothing. `visit`
    /// shrinks the reach.
    template <class Reach, class BoxOf, class Visit>
    void walk(const Reach& reach, BoxOf&& box_of, Visit&& visit) const {
        std::array<Waiting, most_waiting> stack;
        std::size_t waiting = 0;
        const auto push = [&](std::uint32_t level, std::uint32_t x, std::uint32_t y, std::size_t lowest) {
            const auto box = box_of(level, x, y);
            double measure = 0;
            if (is_empty(box) || !reach.measure(box, measure)) return;
            std::size_t place = waiting++;
            for (; place > lowest && stack[place - 1].measure < measure; --place) stack[place] = stack[place - 1];
            stack[place] = {measure, level, x, y};
        };
        push(static_cast<std::uint32_t>(levels_.size()), 0, 0, 0);
        while (waiting > 0 && !reach.over()) {
            const Waiting next = stack[--waiting];
            if (!reach.within(next.measure)) continue;
            if (next.level == 0) {
                visit(next.x, next.y);
                continue;
            }
            const Level& below = next.level == 1 ? cells_ : level_of(next.level - 1);
            const std::uint32_t end_x = std::min(below.columns, (next.x + 1) * side),
                                end_y = std::min(below.rows, (next.y + 1) * side);
            const std::size_t lowest = waiting;
            for (std::uint32_t y = next.y * side; y < end_y; ++y)
                for (std::uint32_t x = next.x * side; x < end_x; ++x) push(next.level - 1, x, y, lowest);
        }
    }

private:
    static constexpr std::uint32_t side = 4;
    /// Of 2^32 cells along an axis there are 16 levels; each leaves all but one of its children waiting.
    static constexpr std::size_t most_waiting = 16 * (side * side - 1) + 1;

    struct Level {
        std::uint32_t columns = 0, rows = 0;
        std::size_t first = 0;  ///< of its summaries

        std::size_t size() const { return std::size_t{columns} * rows; }
    };
    struct Waiting {
        double measure;
        std::uint32_t level, x, y;
    };

    const Level& level_of(std::uint32_t level) const { return levels_[level - 1]; }

    void add(std::uint32_t level, std::uint32_t x, std::uint32_t y, const Summary& below) {
        const Level& of = level_of(level);
        Summary& summary = summaries_[of.first + std::size_t{y / side} * of.columns + x / side];
        summary = merged(summary, below);
    }

    static std::uint32_t first(std::uint32_t level, std::uint32_t i, std::uint32_t count) {
        std::uint64_t result = i;
        for (; level > 0; --level) result *= side;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(result, count));
    }

    Level cells_;
    std::vector<Level> levels_;
    std::vector<Summary> summaries_;
};

/// The cells of an axis that a box may overlap, from the first to before the last: one more on each side than rounding
/// could move it.
struct CellRange {
    std::uint32_t begin = 0, end = 0;

    CellRange(float min, float max, float cell, std::uint32_t count)
        : begin(index(min, cell, -1.0, count)), end(index(max, cell, 2.0, count)) {}
    std::uint32_t size() const { return end > begin ? end - begin : 0; }

private:
    static std::uint32_t index(float at, float cell, double beside, std::uint32_t count) {
        const double place = std::floor(static_cast<double>(at) / static_cast<double>(cell)) + beside;
        return place > 0 ? static_cast<std::uint32_t>(std::min(place, static_cast<double>(count))) : 0;
    }
};

}  // namespace abut
