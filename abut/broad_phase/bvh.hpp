#pragma once

// A tree of boxes: the broad phase for scenes of mixed sizes, for rays, and for what hardly moves.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase: a bounding volume hierarchy (concept.hpp tells what each function does).
///
/// `build` splits where it costs least (binned surface area heuristic): O(n log n). `update` refits the boxes of the
/// tree, O(n), and builds anew where that has made the tree worse than 1.3 times what it was when built (in the sum of
/// its areas: never by a clock), or where a box that was empty at the build holds something now.
///
/// Up to 2^31 items. Memory: 32 bytes an item in 3D (24 in 2D) for its box and index, and as much a node, of which
/// there are about 0.8 an item; room is kept for 2 an item, so that building anew allocates nothing.
template <int D>
class Bvh {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_pair(F&& visit, Executor* executor = nullptr) const {
        visit_pairs(each_pair_to(visit), executor);
    }
    void sorted_pairs(std::vector<ItemPair>& out) const;

    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_overlapping_pair(const Bvh& other, F&& visit) const {
        visit_pairs(other, each_pair_to(visit));
    }
    template <Visitor<std::uint32_t> F>
    void each_overlapping(const Aabb<D>& box, F&& visit) const {
        visit_overlapping(box, go_on_after(visit));
    }
    template <ReachVisitor F>
    void raycast(const Ray<D>& ray, F&& visit) const {
        visit_along(ray, reach_after(visit));
    }
    /// The same for a box on its way; the visitor's reach is in lengths of its direction.
    template <ReachVisitor F>
    void sweep(const MovingBox<D>& box, F&& visit) const {
        visit_along(box, reach_after(visit));
    }
    template <ReachVisitor F>
    void closest(const Aabb<D>& box, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        visit_near(box, reach, reach_after(visit));
    }
    template <ReachVisitor F>
    void closest(const Vec<D>& point, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        visit_near(Aabb<D>{point, point}, reach, reach_after(visit));
    }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const { return nodes_.empty() ? Aabb<D>::empty() : Aabb<D>{nodes_[0].min, nodes_[0].max}; }

private:
    struct Cost {
        double area = 0;
        std::size_t endless = 0;  ///< nodes without bound on some axis
    };

    Cost refit();
    bool has_newcomers(std::span<const Aabb<D>> boxes) const;
    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const Bvh& other, PairsCall visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;

    std::size_t size_ = 0;
    std::vector<BvhItem<D>> items_;  // in the order of the leaves; those that were empty at the build are left out
    std::vector<BvhNode<D>> nodes_;
    Cost built_;
};

extern template class Bvh<2>;
extern template class Bvh<3>;

}  // namespace abut
