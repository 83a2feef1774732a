#pragma once

// Planes that part space: the broad phase for what moves little or never.

#include <abut/broad_phase/bsp_node.hpp>
#include <abut/broad_phase/detail/interface.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase: a tree of planes across the axes, a k-d tree (concept.hpp tells what each function does). Rays and
/// regions find their way by one comparison a level, and stop at the first cell that holds what they look for.
///
/// `build` cuts where it costs least (surface area heuristic, counted in bins, of few items at every face): O(n log n).
/// A box that meets a plane is told to both sides of it where it is narrow against the cell, and is kept at the plane
/// where it is not, or where there are as many copies as items. No answer tells it twice: each has one point of the
/// box, such as the corner of an overlap, and the cell with that point tells it.
///
/// `update` costs a look at each box where nothing has moved. Up to an eighth of the items that have moved are taken
/// out and put in anew, each at the cost of a query; where there are more, where the room for lists is used up, or
/// where as many have been put in anew as there are items, the tree is built anew (counts alone decide, never a clock).
///
/// Up to 2^29 items. Memory: at most 64 bytes an item in 3D (56 in 2D): 28 for its box and index, 16 for nodes, 16 for
/// lists, of which about a third is spare room, and 4 for its place.
template <int D>
class Bsp : public BroadPhaseInterface<Bsp<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    std::size_t size() const { return tree_.items.size(); }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const { return bounds_; }

private:
    friend BroadPhaseInterface<Bsp<D>, D>;
    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const Bsp& other, PairsCall visit) const;
    void visit_boxes(BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;

    BspTree<D> tree_;
    Aabb<D> bounds_ = Aabb<D>::empty();
    std::size_t replaced_ = 0;  ///< how many have been put in anew since the last build
};

extern template class Bsp<2>;
extern template class Bsp<3>;

}  // namespace abut
