#pragma once

// A uniform grid: the broad phase for boxes of similar sizes that all move.

#include <abut/broad_phase/detail/free_indices.hpp>
#include <abut/broad_phase/detail/interface.hpp>
#include <abut/broad_phase/grid/store.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase; concept.hpp documents its functions.
///
/// Every cell that a box touches stores a copy of it: two words that hold its quantised bounds in the cell. SIMD
/// compares one copy with sixteen at a time, by two subtractions for all axes. The words decide nearly all pairs,
/// floats the rest. A pair that shares several cells is reported in the first of them. `update` refills all cells, in
/// O(n), however many boxes moved.
///
/// The cells fill a region around most of the boxes; boxes outside belong to the cells at its border. Boxes that would
/// touch more than 32 cells (16 in 2D) are stored separately and tested against all others, so that a few large boxes
/// do no harm. The edge of the cells is chosen from counts of the data: about thirty boxes per cell, and at least three
/// times the mean edge of the boxes. docs/broad_phases.md has the cost of other edges.
///
/// Raycasts and closest queries visit the cells front to back, and test sixteen boxes at a time.
///
/// With an executor `build` and `update` fill the cells on several threads; the contents of the cells are the same.
///
/// Up to 2^27 items. Memory: at most 62 bytes an item in 3D (54 in 2D), and 50 KB. An executor adds one byte an item,
/// and insertions add up to a quarter as spare capacity.
template <int D>
class Grid : public detail::BroadPhaseInterface<Grid<D>, D> {
public:
    Grid() = default;
    /// Uses cells of this edge, or larger cells if these exceed the limit on memory.
    explicit Grid(float cell_edge) : requested_edge_(cell_edge) {}

    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    /// Adds an item and returns its index: the smallest erased index, or else size(), which grows by one. The indices
    /// of the others stay. If the estimated cost has grown by half, the cell size is chosen anew, in O(n); on average
    /// an insertion takes O(1).
    std::uint32_t insert(const Aabb<D>& box);
    /// Makes an item empty; a new item may reuse its index. The span of an update still has a box for it, an empty
    /// one.
    void erase(std::uint32_t index);
    /// Replaces the box of an item that is not erased. Allocates nothing. Returns false if the capacity doesn't
    /// suffice: no query finds the item then until the next update.
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return boxes_.size(); }
    /// The bounds of all boxes; Aabb::empty() if there are none.
    Aabb<D> bounds() const;
    /// The edge of the cells, as requested or chosen.
    float cell_edge() const { return cells_.edge; }
    /// The estimated cost of finding the pairs, from counts of comparisons and copies. It compares grids of the same
    /// boxes.
    double pair_cost() const { return cost_.time(); }

private:
    friend detail::BroadPhaseInterface<Grid<D>, D>;
    bool visit_large(detail::PairsCall visit) const;
    void visit_pairs(detail::PairsCall visit, Executor* executor) const;
    void visit_pairs(const Grid& other, detail::PairsCall visit) const;
    void visit_boxes(detail::BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const;
    void visit_along(const Ray<D>& ray, detail::ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, detail::ReachCall visit) const;
    template <class Reach>
    void visit_within(Reach reach, detail::ReachCall visit) const;

    /// Counts of the work that the pairs take.
    struct Cost {
        std::uint64_t tiles = 0;   ///< comparisons of sixteen boxes with sixteen
        std::uint64_t copies = 0;  ///< of boxes in cells
        std::uint64_t large = 0;   ///< comparisons of large boxes with all others
        double time() const;
    };

    void reserve(std::size_t count);
    void choose_cells_and_fill(std::span<const Aabb<D>> boxes, Executor* executor);
    void set_edge(float edge);
    void fill_cells(std::span<const Aabb<D>> boxes, Executor* executor);
    bool insert_into_cells(std::uint32_t index);
    void remove_from_cells(std::uint32_t index);
    Cost cost(Executor* executor) const;

    float requested_edge_ = 0;  ///< 0: chosen from the data
    detail::GridCells<D> cells_;
    Aabb<D> region_{};  ///< the box that the cells fill
    detail::GridStore store_;
    std::vector<Aabb<D>> boxes_;
    std::vector<std::uint32_t> large_;  ///< the items that are in no cell
    Cost chosen_cost_, cost_;           ///< when the cells were chosen, and now
    std::size_t capacity_ = 0;          ///< the number of boxes that memory is reserved for
    detail::FreeIndices free_;
    std::vector<std::uint8_t> marks_;  ///< of the items, for a fill on several threads
};

extern template class Grid<2>;
extern template class Grid<3>;

}  // namespace abut
