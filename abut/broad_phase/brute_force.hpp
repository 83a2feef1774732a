#pragma once

// Brute force: tests every box against every other. It is the oracle of the broad phases, and the fastest for a handful
// of boxes.

#include <abut/broad_phase/detail/box_soa.hpp>
#include <abut/broad_phase/detail/free_indices.hpp>
#include <abut/broad_phase/detail/interface.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase without a structure; concept.hpp documents its functions. It visits items in the order of their indices
/// and tests 16 boxes at a time by SIMD. Memory: a copy of the boxes, 24 bytes an item in 3D, 16 in 2D.
template <int D>
class BruteForce : public detail::BroadPhaseInterface<BruteForce<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    /// Adds an item and returns its index: the smallest erased index, or else size(), which grows by one. The indices
    /// of the others stay.
    std::uint32_t insert(const Aabb<D>& box);
    /// Makes an item empty; a new item may reuse its index. The span of an update still has a box for it, an empty
    /// one.
    void erase(std::uint32_t index);
    /// Replaces the box of an item that is not erased. Allocates nothing. Always returns true.
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return size_; }
    /// The bounds of all boxes; Aabb::empty() if there are none.
    Aabb<D> bounds() const;

private:
    friend detail::BroadPhaseInterface<BruteForce<D>, D>;
    void visit_pairs(detail::PairsCall visit, Executor* executor) const;
    void visit_pairs(const BruteForce& other, detail::PairsCall visit) const;
    void visit_boxes(detail::BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const;
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, detail::ReachCall visit) const;

    void write(std::size_t index, const Aabb<D>& box);
    void set_all(std::span<const Aabb<D>> boxes);
    template <class Reach>
    void visit_within(Reach reach, detail::ReachCall visit) const;

    std::size_t size_ = 0;
    detail::BoxSoa<D> boxes_;  // an empty box is stored as NaNs
    detail::FreeIndices free_;
};

extern template class BruteForce<2>;
extern template class BruteForce<3>;

}  // namespace abut
