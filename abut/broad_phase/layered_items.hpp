#pragma once

// What a LayeredGrid knows of its boxes. Not for users.

#include <abut/broad_phase/box_runs.hpp>
#include <abut/broad_phase/layered_cells.hpp>
#include <abut/math/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The guests' rows are longer by so many words, and those of the places: vectors are read and written whole.
inline constexpr std::size_t guest_slack = 16;

using SpareCell = std::array<std::uint32_t, 8>;
static_assert(sizeof(SpareCell) == sizeof(LayeredCell));

/// The items have places: in the order of their cells, so layer by layer, and last those without a cell ("strays":
/// without bound, too large, too far out) by where they begin. Empty boxes have none.
template <int D>
struct LayeredItems {
    std::vector<Aabb<D>> boxes;        ///< by place
    std::vector<std::uint32_t> index;  ///< by place: in the span that the user gave
    std::vector<std::uint32_t> low;    ///< by place: CellFormat, in the cell where the item begins
    std::vector<std::uint32_t> high;
    std::uint32_t with_cell = 0;  ///< the strays' places begin here

    std::vector<std::uint32_t> guest_low;  ///< cell by cell
    std::vector<std::uint32_t> guest_high;
    std::vector<std::uint32_t> guest_place;

    /// Sorted by layer, then as before_on_the_way has them; after those, cells that only have guests and are new.
    std::vector<LayeredCell> cells;
    std::uint32_t sorted_cells = 0;
    CellTable table;

    std::array<BoxRuns, most_layers + 1> runs;  ///< of each layer, and of the strays
    std::vector<Aabb<D>> nodes;                 ///< of the runs
    Aabb<D> bounds = Aabb<D>::empty();

    /// By cell: for each set of axes, the cell that sends guests over these. While cells are sorted, they lie here.
    std::vector<SpareCell> spare;

    /// The boxes or nodes of a level of a tree.
    const Aabb<D>* row(const BoxRuns& tree, int level) const {
        return (level == 0 ? boxes.data() : nodes.data()) + tree.first[static_cast<std::size_t>(level)];
    }

    void reserve(std::size_t count);
    /// Takes the boxes in. Cells from before stay as they are, for they have to be of the same plan.
    void fill(const LayeredPlan<D>& plan, std::span<const Aabb<D>> given);
    void forget_cells();
    /// How much there is to compare, roughly: pairs within cells, and with the cell around.
    double work() const;
};

}  // namespace abut
