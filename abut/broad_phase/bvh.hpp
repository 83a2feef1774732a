#pragma once

// A bounding volume hierarchy (BVH): the broad phase for mixed sizes, for rays, and for boxes that hardly move.

#include <abut/broad_phase/bvh/tree.hpp>
#include <abut/broad_phase/detail/interface.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

struct BvhAccess;

}  // namespace abut::detail

namespace abut {

/// A BroadPhase; concept.hpp documents its functions. A node has eight children and a leaf has up to eight items, whose
/// boxes SIMD tests together.
///
/// `build` splits by the binned surface area heuristic (SAH), in O(n log n). `update` refits the boxes of the tree, in
/// O(n), and rebuilds the subtrees whose sum of areas has grown since they were built. So the tree stays about as good
/// as a new one, however long the boxes move. With an executor both run on several threads; the tree is the same.
///
/// Up to 2^31 items. Memory: 79 bytes an item in 3D (59 in 2D) if there are many. That includes up to 190 kilobytes of
/// working memory, and as much again for each further thread that builds.
template <int D>
class Bvh : public detail::BroadPhaseInterface<Bvh<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    /// Adds an item, in O(log n), and returns its index: the smallest erased index, or else size(), which grows by one.
    /// The indices of the others stay. The tree may become somewhat worse until the next update.
    std::uint32_t insert(const Aabb<D>& box);
    /// Makes an item empty, in O(log n); a new item may reuse its index. The span of an update still has a box for it,
    /// an empty one.
    void erase(std::uint32_t index);
    /// Replaces the box of an item that is not erased. Allocates nothing. Returns false if the capacity doesn't
    /// suffice: no query finds the item then until the next update.
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return tree_.size(); }
    /// The bounds of all boxes; Aabb::empty() if there are none.
    Aabb<D> bounds() const { return tree_.bounds(); }
    /// The SAH cost: the expected number of nodes and leaves that a random ray through the bounds visits, which is the
    /// sum of their areas divided by that of the bounds. It compares trees of the same boxes.
    double cost() const { return tree_.cost(); }

private:
    friend detail::BroadPhaseInterface<Bvh<D>, D>;
    friend struct detail::BvhAccess;
    void visit_pairs(detail::PairsCall visit, Executor* executor) const;
    void visit_pairs(const Bvh& other, detail::PairsCall visit) const;
    void visit_boxes(detail::BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const;
    void visit_along(const Ray<D>& ray, detail::ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, detail::ReachCall visit) const;

    detail::BvhTree<D> tree_;
};

extern template class Bvh<2>;
extern template class Bvh<3>;

}  // namespace abut
