#pragma once

// Every box against every other: the oracle of the broad phases, and the best of them for a handful of boxes.

#include <abut/broad_phase/box_table.hpp>
#include <abut/broad_phase/face.hpp>
#include <abut/broad_phase/free_items.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase without a structure (concept.hpp tells what each function does). Visits in the order of the indices.
/// Keeps a copy of the boxes, 16 of which are compared at a time: 24 bytes an item in 3D, 16 in 2D.
template <int D>
class BruteForce : public BroadPhaseFace<BruteForce<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    /// A new item. Returns its index: the least of those that were erased, or else size(), which grows by one. The
    /// indices of the others stay.
    std::uint32_t insert(const Aabb<D>& box);
    /// Makes an item empty; its index may be given to a new one. In the span of an update it has a box still, an empty
    /// one.
    void erase(std::uint32_t index);
    /// Another box for an item that was not erased. Allocates nothing, and is always true.
    bool set(std::uint32_t index, const Aabb<D>& box);

    std::size_t size() const { return size_; }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const;

private:
    friend BroadPhaseFace<BruteForce<D>, D>;
    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const BruteForce& other, PairsCall visit) const;
    void visit_boxes(BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;

    void write(std::size_t index, const Aabb<D>& box);
    void set_all(std::span<const Aabb<D>> boxes);
    template <class Reach>
    void visit_within(Reach reach, ReachCall visit) const;

    std::size_t size_ = 0;
    BoxTable<D> boxes_;  // those that are empty are NaN
    FreeItems free_;
};

extern template class BruteForce<2>;
extern template class BruteForce<3>;

}  // namespace abut
