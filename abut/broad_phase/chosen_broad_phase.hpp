#pragma once

// A broad phase that switches between the others to suit its boxes.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/broad_phase/detail/interface.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>

#include <optional>
#include <variant>

namespace abut {

/// A BroadPhase; concept.hpp documents its functions. It calls `choose_broad_phase` in a build, at every 64th update,
/// and at the next update after the history changed by a factor of two. If the choice differs, it builds the other
/// structure; that update takes as long as a build, and allocates. Memory: that of the current structure.
template <int D>
class ChosenBroadPhase : public detail::BroadPhaseInterface<ChosenBroadPhase<D>, D> {
public:
    ChosenBroadPhase() = default;
    /// Always uses this structure: for tests and measurements.
    explicit ChosenBroadPhase(BroadPhaseKind always) : always_(always) { become(always); }

    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    /// Adds an item of index size() with an empty box, for `set` to replace. Returns false if the structure doesn't
    /// support it: then it must be built anew.
    bool grow();
    /// Replaces the box of an item. Allocates nothing. Returns false if the structure doesn't support it or lacks the
    /// capacity: no query finds the item then until the next update.
    bool set(std::uint32_t index, const Aabb<D>& box);
    /// Updates without a change of structure. Allocates nothing.
    void refit(std::span<const Aabb<D>> boxes);
    /// Sets how the boxes move and how often they are queried, for the next choice. A rate of queries between half and
    /// twice that of the last choice doesn't make the next choice earlier.
    void set_history(const BroadPhaseHistory& history);

    std::size_t size() const;
    /// The bounds of all boxes; Aabb::empty() if there are none.
    Aabb<D> bounds() const;
    BroadPhaseKind kind() const { return static_cast<BroadPhaseKind>(phase_.index()); }

private:
    friend detail::BroadPhaseInterface<ChosenBroadPhase<D>, D>;
    void visit_pairs(detail::PairsCall visit, Executor* executor) const;
    void visit_pairs(const ChosenBroadPhase& other, detail::PairsCall visit) const;
    void visit_boxes(detail::BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const;
    void visit_along(const Ray<D>& ray, detail::ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, detail::ReachCall visit) const;

    BroadPhaseKind choose(std::span<const Aabb<D>> boxes) const;
    void become(BroadPhaseKind kind);

    /// In the order of BroadPhaseKind.
    std::variant<BruteForce<D>, Grid<D>, LayeredGrid<D>, SweepAndPrune<D>, Bvh<D>, Bsp<D>> phase_;
    std::optional<BroadPhaseKind> always_;
    BroadPhaseHistory history_;
    double chosen_queries_ = 0;  ///< the rate of queries at the last choice
    std::uint32_t updates_ = 0;
};

extern template class ChosenBroadPhase<2>;
extern template class ChosenBroadPhase<3>;

}  // namespace abut
