#pragma once

// Hierarchy over the cells of a grid, with a branching factor of 4 along each axis: each level summarises blocks of the
// level below, and the top level is one block. Searches traverse it like a tree. For .cpp files.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/aabb.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace abut::detail {

/// The place of a cell or of a block: its index along each axis.
template <int D>
using CellPlace = glm::vec<D, std::uint32_t>;

/// Calls visit(place) for the places from `first` to the one before `end`, x first, until it returns false.
template <int D, class Visit>
void each_place(const CellPlace<D>& first, const CellPlace<D>& end, Visit&& visit) {
    CellPlace<D> place = first;
    const std::uint32_t first_z = D == 3 ? first[D - 1] : 0, end_z = D == 3 ? end[D - 1] : 1;
    for (std::uint32_t z = first_z; z < end_z; ++z) {
        if constexpr (D == 3) place[2] = z;
        for (place[1] = first[1]; place[1] < end[1]; ++place[1])
            for (place[0] = first[0]; place[0] < end[0]; ++place[0])
                if (!visit(place)) return;
    }
}

/// The index of a place, row by row.
template <int D>
std::size_t index_of(const CellPlace<D>& place, const CellPlace<D>& count) {
    std::size_t result = place[D - 1];
    for (int axis = D - 2; axis >= 0; --axis) result = result * count[axis] + place[axis];
    return result;
}

/// `Summary` holds what is known of a block. Its default is that of an empty block; `merged(a, b)` combines two.
template <class Summary, int D = 2>
class GridHierarchy {
public:
    using Place = CellPlace<D>;

    /// Builds the levels from `summary_of(place)` of each cell. There is at least one cell.
    template <class CellSummary>
    void build(const Place& cells, CellSummary&& summary_of) {
        cells_ = cells;
        levels_.clear();
        std::size_t size = 0;
        for (Level last{cells, 0}; levels_.empty() || last.count != Place(1u);) {
            last = {(last.count - 1u) / side + 1u, size};
            size += index_of<D>(last.count - 1u, last.count) + 1;
            levels_.push_back(last);
        }
        summaries_.resize(size);
        update(Place(0u), cells, summary_of);
    }

    /// Brings the levels up to date where the summaries of some cells have changed: those from `first` to the one
    /// before `end`.
    template <class CellSummary>
    void update(Place first, Place end, CellSummary&& summary_of) {
        Place below = cells_;
        for (std::uint32_t level = 1; level <= levels_.size(); below = level_of(level++).count) {
            first /= side;
            end = (end - 1u) / side + 1u;
            const Level& of = level_of(level);
            each_place<D>(first, end, [&](const Place& block) {
                Summary summary;
                each_place<D>(block * side, glm::min(below, (block + 1u) * side), [&](const Place& part) {
                    summary = merged(summary, level == 1 ? summary_of(part) : at(level - 1, part));
                    return true;
                });
                summaries_[of.first + index_of<D>(block, of.count)] = summary;
                return true;
            });
        }
    }

    /// The summary of a block. Levels count from 1.
    const Summary& at(std::uint32_t level, const Place& block) const {
        const Level& of = level_of(level);
        return summaries_[of.first + index_of<D>(block, of.count)];
    }
    const Summary& all() const { return summaries_.back(); }

    /// The first cell of a block.
    Place first_cell(std::uint32_t level, const Place& block) const {
        Place result;
        for (int axis = 0; axis < D; ++axis) {
            std::uint64_t first = block[axis];
            for (std::uint32_t i = level; i > 0; --i) first *= side;
            result[axis] = static_cast<std::uint32_t>(std::min<std::uint64_t>(first, cells_[axis]));
        }
        return result;
    }

    std::size_t bytes() const { return summaries_.size() * sizeof(Summary); }

    /// Calls visit(place) for the cells within reach, a RayReach or BoxReach, nearest first among the children of a
    /// block. `box_of(level, place)` is the box of a block, or of a cell at level 0; an empty box is skipped. `visit`
    /// shrinks the reach. `narrow(level, first, end)` may narrow the range of blocks, or of cells at level 0, that are
    /// children of one block: those left out are beyond the reach.
    template <class Reach, class BoxOf, class Visit, class Narrow>
    void traverse(const Reach& reach, BoxOf&& box_of, Visit&& visit, Narrow&& narrow) const {
        std::array<StackEntry, max_stack> stack;
        std::size_t stack_size = 0;
        const auto push = [&](std::uint32_t level, const Place& place, std::size_t bottom) {
            const auto box = box_of(level, place);
            double measure = 0;
            if (is_empty(box) || !reach.measure(box, measure)) return;
            std::size_t at = stack_size++;
            for (; at > bottom && stack[at - 1].measure < measure; --at) stack[at] = stack[at - 1];
            stack[at] = {measure, level, place};
        };
        push(static_cast<std::uint32_t>(levels_.size()), Place(0u), 0);
        while (stack_size > 0 && !reach.is_exhausted()) {
            const StackEntry next = stack[--stack_size];
            if (!reach.within(next.measure)) continue;
            if (next.level == 0) {
                visit(next.place);
                continue;
            }
            const Place& below = next.level == 1 ? cells_ : level_of(next.level - 1).count;
            const std::size_t bottom = stack_size;
            Place first = next.place * side, end = glm::min(below, (next.place + 1u) * side);
            narrow(next.level - 1, first, end);
            each_place<D>(first, end, [&](const Place& place) {
                push(next.level - 1, place, bottom);
                return true;
            });
        }
    }
    template <class Reach, class BoxOf, class Visit>
    void traverse(const Reach& reach, BoxOf&& box_of, Visit&& visit) const {
        traverse(reach, box_of, visit, [](std::uint32_t, Place&, Place&) {});
    }

    /// The number of cells along the edge of a block.
    static double width(std::uint32_t level) { return static_cast<double>(std::uint64_t{1} << 2 * level); }

private:
    static constexpr std::uint32_t side = 4;
    /// 2^32 cells along an axis make 16 levels; each level leaves all but one of its children on the stack.
    static constexpr std::size_t max_stack = 16 * ((D == 2 ? 16 : 64) - 1) + 1;

    struct Level {
        Place count;            ///< of blocks along each axis
        std::size_t first = 0;  ///< index of its first summary
    };
    struct StackEntry {
        double measure;
        std::uint32_t level;
        Place place;
    };

    const Level& level_of(std::uint32_t level) const { return levels_[level - 1]; }

    Place cells_{};
    std::vector<Level> levels_;
    std::vector<Summary> summaries_;
};

/// A box that overlaps at most this many cells visits them directly, without the hierarchy.
inline constexpr std::uint64_t max_direct_cells = 64;

/// The cells from `begin` to the one before `end` that a box may overlap, padded by one cell on each side against
/// rounding.
template <int D>
struct CellRange {
    CellPlace<D> begin{}, end{};

    CellRange(const Aabb<D>& box, const Vec<D>& cell, const CellPlace<D>& count) {
        for (int axis = 0; axis < D; ++axis) {
            begin[axis] = index(box.min[axis], cell[axis], -1.0, count[axis]);
            end[axis] = index(box.max[axis], cell[axis], 2.0, count[axis]);
        }
    }
    /// The number of cells; large numbers may be rounded.
    double size() const {
        double result = 1;
        for (int axis = 0; axis < D; ++axis) result *= end[axis] > begin[axis] ? end[axis] - begin[axis] : 0;
        return result;
    }

private:
    static std::uint32_t index(float at, float cell, double extra, std::uint32_t count) {
        const double place = std::floor(static_cast<double>(at) / static_cast<double>(cell)) + extra;
        return place > 0 ? static_cast<std::uint32_t>(std::min(place, static_cast<double>(count))) : 0;
    }
};

}  // namespace abut::detail
