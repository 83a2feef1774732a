#pragma once

// A tree of splitting planes: the textbook structure for rays and regions among boxes that never move.

#include <abut/broad_phase/detail/interface.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

namespace detail {
class PairBuffer;
}

/// A BroadPhase: a binary space partitioning tree whose planes are axis-aligned, a k-d tree (concept.hpp documents each
/// function).
///
/// Each inner node splits its boxes by a plane into three subtrees: those below the plane, those above it, and those
/// that straddle it, which are then split along the other axes. Each box is therefore stored once, in one leaf. Boxes
/// below and above a plane never overlap, so a query descends only into the sides that it reaches.
///
/// `build` puts the plane through the median of the centers, on the axis where the fewest boxes straddle it:
/// O(n log n). `update` compares the boxes with those stored, and rebuilds if one has moved.
///
/// Christer Ericson, "Real-Time Collision Detection", 2005, sections 7.3 and 8.
///
/// Up to 2^31 items. Memory: at most 132 bytes an item in 3D, 116 in 2D.
template <int D>
class Bsp : public detail::BroadPhaseInterface<Bsp<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    std::size_t size() const { return size_; }
    /// The common box of all items; Aabb::empty() without any.
    Aabb<D> bounds() const { return bounds_; }

private:
    friend detail::BroadPhaseInterface<Bsp<D>, D>;
    struct Entry {
        Aabb<D> box;
        std::uint32_t item;
    };
    /// A child is an index of a node; 0 stands for none.
    struct Node {
        std::uint32_t begin, end;     ///< of the boxes in the subtree
        std::uint32_t below = 0;      ///< the boxes that end before the plane; 0 in a leaf
        std::uint32_t above = 0;      ///< the boxes that begin at the plane or behind it
        std::uint32_t straddles = 0;  ///< the others
        std::int32_t axis = 0;
        float plane = 0;
        float low = 0, high = 0;  ///< the bounds of the straddling boxes on the axis
    };
    struct Split {
        std::int32_t axis = -1;
        float plane = 0;
    };

    std::uint32_t build_node(std::uint32_t begin, std::uint32_t end, int depth);
    Split choose_split(std::uint32_t begin, std::uint32_t end);
    template <class Visit>
    bool visit_region(std::uint32_t node, const Aabb<D>& box, const Visit& visit) const;
    bool visit_pairs_of(std::uint32_t node, detail::PairBuffer& pairs) const;
    template <class Reach>
    void visit_within(std::uint32_t node, const Aabb<D>& cell, Reach& reach, detail::ReachCall visit) const;

    void visit_pairs(detail::PairsCall visit, Executor* executor) const;
    void visit_pairs(const Bsp& other, detail::PairsCall visit) const;
    void visit_boxes(detail::BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const;
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, detail::ReachCall visit) const;

    std::size_t size_ = 0;
    std::vector<Entry> entries_, scratch_;  ///< the boxes that are not empty, leaf by leaf
    std::vector<Node> nodes_;
    std::vector<float> centers_;
    Aabb<D> bounds_ = Aabb<D>::empty();
};

extern template class Bsp<2>;
extern template class Bsp<3>;

}  // namespace abut
