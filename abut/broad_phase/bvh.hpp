#pragma once

// A tree of boxes: the broad phase for scenes of mixed sizes, for rays, and for what hardly moves.

#include <abut/broad_phase/bvh_tree.hpp>
#include <abut/broad_phase/face.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase: a bounding volume hierarchy (concept.hpp tells what each function does). Its nodes have eight children
/// and its leaves up to eight items, which are asked together.
///
/// `build` splits where it costs least (binned surface area heuristic): O(n log n). `update` refits the boxes of the
/// tree, O(n), and puts together anew those parts of it that have grown worse than they were when they were built (in
/// the sum of their areas: never by a clock): however long things move about, the tree stays about as good as a new
/// one. With an executor both do so on several threads; the tree is the same.
///
/// Up to 2^31 items. Memory: 56 bytes an item in 3D (50 in 2D) where there are many; of that, up to 190 kilobytes are
/// for work, and as much again for each thread more that builds.
template <int D>
class Bvh : public BroadPhaseFace<Bvh<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    /// A new item, in O(log n). Returns its index: the least of those that were erased, or else size(), which grows by
    /// one. The indices of the others stay. The tree may grow somewhat worse: the next update repairs that.
    std::uint32_t insert(const Aabb<D>& box);
    /// Makes an item empty, in O(log n); its index may be given to a new one. In the span of an update it has a box
    /// still, an empty one.
    void erase(std::uint32_t index);
    /// Another box for an item that was not erased. Allocates nothing. False where that takes more room than there is:
    /// the item is not found then until the next update.
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return tree_.size(); }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const { return tree_.bounds(); }
    /// About how many nodes and leaves a ray through the bounds comes by: the sum of their areas, as parts of that of
    /// the bounds. To compare trees of the same boxes by.
    double cost() const { return tree_.cost(); }

private:
    friend BroadPhaseFace<Bvh<D>, D>;
    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const Bvh& other, PairsCall visit) const;
    void visit_boxes(BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;

    BvhTree<D> tree_;
};

extern template class Bvh<2>;
extern template class Bvh<3>;

}  // namespace abut
