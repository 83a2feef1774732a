#pragma once

// A broad phase that is whichever of the others suits its boxes.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/broad_phase/face.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>

#include <optional>
#include <variant>

namespace abut {

/// A BroadPhase (concept.hpp tells what each function does). It looks at its boxes when it is built, at every 64th
/// update, and at the next one after it was told of a history unlike the last, and becomes another structure where
/// `choose_broad_phase` says so; that update takes as long as a build, and allocates. Memory: that of the structure it
/// is.
template <int D>
class ChosenBroadPhase : public BroadPhaseFace<ChosenBroadPhase<D>, D> {
public:
    ChosenBroadPhase() = default;
    /// Is always this one: for tests and measurements.
    explicit ChosenBroadPhase(BroadPhaseKind always) : always_(always) { become(always); }

    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    /// A new item of the index size(), with an empty box, so that `set` may give it another. False where the structure
    /// cannot: then all must be built.
    bool grow();
    /// Another box for an item. Allocates nothing. False where the structure cannot, or has no room for it: the item is
    /// not found then until the next update.
    bool set(std::uint32_t index, const Aabb<D>& box);
    /// As an update, by the structure that it is. Allocates nothing.
    void refit(std::span<const Aabb<D>> boxes);
    /// How the boxes move, and how often they are asked for, of late, for the next choice. Where that is more than half
    /// and less than twice of what it was at the last look, the next one is not before it is due.
    void tell(const BroadPhaseHistory& history);

    std::size_t size() const;
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const;
    BroadPhaseKind kind() const { return static_cast<BroadPhaseKind>(phase_.index()); }

private:
    friend BroadPhaseFace<ChosenBroadPhase<D>, D>;
    void visit_pairs(PairsCall visit, Executor* executor) const;
    void visit_pairs(const ChosenBroadPhase& other, PairsCall visit) const;
    void visit_boxes(BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void visit_along(const Ray<D>& ray, ReachCall visit) const;
    void visit_along(const MovingBox<D>& box, ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, ReachCall visit) const;

    BroadPhaseKind wanted(std::span<const Aabb<D>> boxes) const;
    void become(BroadPhaseKind kind);

    /// In the order of BroadPhaseKind.
    std::variant<BruteForce<D>, Grid<D>, LayeredGrid<D>, SweepAndPrune<D>, Bvh<D>, Bsp<D>> phase_;
    std::optional<BroadPhaseKind> always_;
    BroadPhaseHistory history_;
    double asked_ = 0;  ///< as it was told when it last looked
    std::uint32_t updates_ = 0;
};

extern template class ChosenBroadPhase<2>;
extern template class ChosenBroadPhase<3>;

}  // namespace abut
