#pragma once

// A uniform grid: the broad phase for boxes of like sizes that all move.

#include <abut/broad_phase/face.hpp>
#include <abut/broad_phase/free_items.hpp>
#include <abut/broad_phase/grid_store.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase: a uniform grid (concept.hpp tells what each function does).
///
/// Each box is written into all cells that it touches, as two words that hold its place in the cell; in a cell, sixteen
/// boxes are compared with one at a time, by two subtractions for all axes. The words decide nearly all pairs, floats
/// the rest. A pair that has several cells in common is told in the first of them. `update` writes all cells anew:
/// O(n), whether much moved or nothing.
///
/// The cells fill a block around most of the boxes; what lies outside belongs to the cells at its border. Boxes that
/// would touch more than 32 cells (16 in 2D) are kept by themselves and compared with all others, so that a few giants
/// do no harm; for many sizes take LayeredGrid. The edge of the cells is chosen from the data by counting: about thirty
/// boxes a cell, and no less than three times their mean edge. docs/broad_phases.md has what other edges cost.
///
/// Rays and searches for what is near go from cell to cell, the first ones first, and look at sixteen boxes at a time.
///
/// With an executor `build` and `update` fill the cells on several threads; what lies in them is the same.
///
/// Up to 2^27 items. Memory: at most 62 bytes an item in 3D (54 in 2D), and 50 KB; one byte an item more with an
/// executor, and up to a quarter more once items were inserted, for those to come.
template <int D>
class Grid : public BroadPhaseFace<Grid<D>, D> {
public:
    Grid() = default;
    /// With cells of this edge; larger ones where memory would not do.
    explicit Grid(float cell_edge) : wanted_edge_(cell_edge) {}

    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    /// A new item. Returns its index: the least of those that were erased, or else size(), which grows by one. The
    /// indices of the others stay. Cells are chosen anew whenever the boxes have come to cost half as much again: some
    /// such call takes O(n), on average it is O(1).
    std::uint32_t insert(const Aabb<D>& box);
    /// Makes an item empty; its index may be given to a new one. In the span of an update it has a box still, an empty
    /// one.
    void erase(std::uint32_t index);
    /// Another box for an item that was not erased. Allocates nothing. False where that takes more room than there is:
    /// the item is not found then until the next update.
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return boxes_.size(); }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const;
    /// Of the cells, as it was given or chosen.
    float cell_edge() const { return cells_.edge; }
    /// About what finding the pairs costs, by what is compared and copied. To compare grids of the same boxes by.
    double pair_cost() const { return cost_.time(); }

private:
    friend BroadPhaseFace<Grid<D>, D>;
    bool visit_large(PairsCall visit) const;
    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const Grid& other, PairsCall visit) const;
    void visit_boxes(BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;
    template <class Reach>
    void visit_within(Reach reach, ReachCall visit) const;

    /// What the pairs cost, by counting.
    struct Cost {
        std::uint64_t tiles = 0;  ///< sixteen boxes against sixteen
        std::uint64_t copies = 0;
        std::uint64_t single = 0;  ///< large ones against all others
        double time() const;
    };

    void reserve(std::size_t count);
    void plan(std::span<const Aabb<D>> boxes, Executor* executor);
    void set_edge(float edge);
    void fill_cells(std::span<const Aabb<D>> boxes, Executor* executor);
    bool put(std::uint32_t index);
    void take_out(std::uint32_t index);
    Cost cost(Executor* executor) const;

    float wanted_edge_ = 0;
    GridCells<D> cells_;
    Aabb<D> block_{};  ///< that the cells fill
    GridStore store_;
    std::vector<Aabb<D>> boxes_;
    std::vector<std::uint32_t> large_;  ///< those that are in no cell
    Cost planned_, cost_;               ///< when the cells were chosen, and now
    std::size_t reserved_ = 0;          ///< there is room for so many boxes
    FreeItems free_;
    std::vector<std::uint8_t> marks_;  ///< for several threads that fill cells
};

extern template class Grid<2>;
extern template class Grid<3>;

}  // namespace abut
