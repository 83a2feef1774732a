#pragma once

// Boxes in the order of where they begin along an axis: the broad phase for pairs among many that all move.

#include <abut/broad_phase/detail/interface.hpp>
#include <abut/broad_phase/sweep_plan.hpp>
#include <abut/broad_phase/sweep_rows.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase: sweep and prune, in columns (concept.hpp tells what each function does).
///
/// Sorts along the axis on which the fewest boxes overlap. Where that leaves too many comparisons (a sweep along one
/// axis takes n^(5/3) in 3D), space is parted into columns along the other axes, and a box is copied into each that it
/// reaches; a pair is told in the first column that has both. Every 16 boxes of a column have a common box, 16 of these
/// again, and so on: with them queries look at a few of the boxes only.
///
/// `update` puts the boxes in order anew, from the last order where that is nearly right. Axis and columns are chosen
/// at the build from a sample of the boxes, and again where the comparisons have become 1.3 times those after it: by
/// counting, never by a clock.
///
/// Up to 2^30 items. Memory: at most 63 bytes an item in 3D (50 in 2D), and some hundred for each structure.
template <int D>
class SweepAndPrune : public BroadPhaseInterface<SweepAndPrune<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    std::size_t size() const { return size_; }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const { return bounds_; }
    /// The axis and the columns it has chosen; for tests and for those who want to see.
    const SweepPlan<D>& plan() const { return plan_; }

private:
    friend BroadPhaseInterface<SweepAndPrune<D>, D>;
    struct Place {
        std::uint32_t key;  ///< the lower bound along the axis, as a whole number of the same order
        std::uint32_t item;
    };
    void place_by_new_plan(std::span<const Aabb<D>> boxes);
    bool sort_again(std::span<const Aabb<D>> boxes);
    void sort_anew(std::span<const Aabb<D>> boxes);
    void place(std::span<const Aabb<D>> boxes);
    template <int axis>
    void place_along(std::span<const Aabb<D>> boxes);
    template <int axis>
    std::size_t count_copies(std::span<const Aabb<D>> boxes);
    void copy_items();
    template <int axis>
    void copy_boxes(std::span<const Aabb<D>> boxes);
    double cost() const;

    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const SweepAndPrune& other, PairsCall visit) const;
    void visit_boxes(BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;

    std::size_t size_ = 0;
    SweepPlan<D> plan_;
    double built_cost_ = 0;
    Aabb<D> bounds_ = Aabb<D>::empty();

    std::vector<Place> order_, scratch_;  // all items; those that are empty are the last
    std::size_t filled_ = 0;              // of the order: the items that hold something
    std::vector<std::uint32_t> columns_;  // where each of them ends in the rows, at a box of NaNs
    SweepRows<D> rows_;                   // all axes turned so that the plan's is axis 0
};

extern template class SweepAndPrune<2>;
extern template class SweepAndPrune<3>;

}  // namespace abut
