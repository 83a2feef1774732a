#pragma once

// Boxes in the order of where they begin along an axis: the broad phase for pairs among many that all move.

#include <abut/broad_phase/sweep_plan.hpp>
#include <abut/broad_phase/sweep_rows.hpp>
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
class SweepAndPrune {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_pair(F&& visit, Executor* executor = nullptr) const {
        visit_pairs(each_pair_to(visit), executor);
    }
    void sorted_pairs(std::vector<ItemPair>& out) const;

    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_overlapping_pair(const SweepAndPrune& other, F&& visit) const {
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
    Aabb<D> bounds() const { return bounds_; }
    /// The axis and the columns it has chosen; for tests and for those who want to see.
    const SweepPlan<D>& plan() const { return plan_; }

private:
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
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
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
