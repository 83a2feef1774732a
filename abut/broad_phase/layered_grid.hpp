#pragma once

// Grids over grids: the broad phase for boxes of all sizes, near together here and far apart there, that all move.

#include <abut/broad_phase/detail/interface.hpp>
#include <abut/broad_phase/layered_cells.hpp>
#include <abut/broad_phase/layered_items.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase: a few uniform grids, whose cells lie in one another (concept.hpp tells what each function does).
///
/// A box belongs to the finest layer whose cells are as long as its longest edge, and is written in each cell of it
/// that it touches (one to four in the plane, one to eight in space; with the cells that are chosen about two). Boxes
/// of one layer meet in a cell of theirs, boxes of two layers in the coarser one's cell around the finer one's. Only
/// cells that hold something exist, so empty space and giant boxes cost nothing. Boxes without bound, and those farther
/// from the middle of the others than about 10^12 of their edges, are tried against all.
///
/// Which layers there are is chosen from the sizes and the gaps of the boxes at the build, and again in an update where
/// the boxes have come to lie so differently that the work has grown by half. An update takes O(n) time, however far
/// the boxes have moved. Rays and the other queries go through a tree over the boxes in the order of their cells.
///
/// Up to 2^31 items. Memory: 40 bytes an item in 3D (32 in 2D), 12 for each cell that it touches beyond the first, and
/// 80 for each cell: about 64 in all for boxes that touch a few others, more where they are strewn thin. Room is kept
/// for two more cells an item and half as many cells as items, 110 bytes an item in all; a world so strewn about that
/// it needs more makes an update allocate once.
template <int D>
class LayeredGrid : public BroadPhaseInterface<LayeredGrid<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    std::size_t size() const { return size_; }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const { return items_.bounds; }

private:
    friend BroadPhaseInterface<LayeredGrid<D>, D>;
    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const LayeredGrid& other, PairsCall visit) const;
    void visit_boxes(BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;

    std::size_t size_ = 0;
    LayeredPlan<D> plan_;
    double planned_work_ = 0;  // just after the last plan
    LayeredItems<D> items_;
};

extern template class LayeredGrid<2>;
extern template class LayeredGrid<3>;

}  // namespace abut
