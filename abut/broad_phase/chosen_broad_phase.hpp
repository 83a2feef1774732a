#pragma once

// A broad phase that is whichever of the others suits its boxes.

#include <abut/broad_phase/brute_force.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/layered_grid.hpp>
#include <abut/broad_phase/sweep_and_prune.hpp>

#include <variant>

namespace abut {

/// A BroadPhase but for each_overlapping_pair (concept.hpp tells what each function does). It looks at its boxes when
/// it is built, and at every 64th update, and becomes another structure where `choose_broad_phase` says so; that update
/// takes as long as a build, and allocates. Memory: that of the structure it is.
template <int D>
class ChosenBroadPhase {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr) {
        const BroadPhaseKind wanted = choose_broad_phase<D>(boxes, history_);
        if (wanted != kind()) become(wanted);
        updates_ = 0;
        std::visit([&](auto& phase) { phase.build(boxes, executor); }, phase_);
    }
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr) {
        constexpr std::uint32_t between = 64;
        if (boxes.size() != size() || (++updates_ % between == 0 && choose_broad_phase<D>(boxes, history_) != kind()))
            return build(boxes, executor);
        std::visit([&](auto& phase) { phase.update(boxes, executor); }, phase_);
    }
    /// How the boxes move, and how often they are asked for, for the next choice.
    void tell(const BroadPhaseHistory& history) { history_ = history; }

    template <Visitor<std::uint32_t, std::uint32_t> F>
    void each_pair(F&& visit, Executor* executor = nullptr) const {
        std::visit([&](const auto& phase) { phase.each_pair(visit, executor); }, phase_);
    }
    void sorted_pairs(std::vector<ItemPair>& out) const {
        std::visit([&](const auto& phase) { phase.sorted_pairs(out); }, phase_);
    }
    template <Visitor<std::uint32_t> F>
    void each_overlapping(const Aabb<D>& box, F&& visit) const {
        std::visit([&](const auto& phase) { phase.each_overlapping(box, visit); }, phase_);
    }
    template <ReachVisitor F>
    void raycast(const Ray<D>& ray, F&& visit) const {
        std::visit([&](const auto& phase) { phase.raycast(ray, visit); }, phase_);
    }
    template <ReachVisitor F>
    void closest(const Aabb<D>& box, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        std::visit([&](const auto& phase) { phase.closest(box, visit, reach); }, phase_);
    }
    template <ReachVisitor F>
    void closest(const Vec<D>& point, F&& visit, float reach = std::numeric_limits<float>::infinity()) const {
        std::visit([&](const auto& phase) { phase.closest(point, visit, reach); }, phase_);
    }

    std::size_t size() const {
        return std::visit([](const auto& phase) { return phase.size(); }, phase_);
    }
    bool empty() const { return size() == 0; }
    /// Of all boxes together; Aabb::empty() where there is none.
    Aabb<D> bounds() const {
        return std::visit([](const auto& phase) { return phase.bounds(); }, phase_);
    }
    BroadPhaseKind kind() const { return static_cast<BroadPhaseKind>(phase_.index()); }

private:
    void become(BroadPhaseKind kind) {
        switch (kind) {
            case BroadPhaseKind::brute_force:
                phase_.template emplace<BruteForce<D>>();
                break;
            case BroadPhaseKind::grid:
                phase_.template emplace<Grid<D>>();
                break;
            case BroadPhaseKind::layered_grid:
                phase_.template emplace<LayeredGrid<D>>();
                break;
            case BroadPhaseKind::sweep_and_prune:
                phase_.template emplace<SweepAndPrune<D>>();
                break;
            case BroadPhaseKind::bvh:
                phase_.template emplace<Bvh<D>>();
                break;
            case BroadPhaseKind::bsp:
                phase_.template emplace<Bsp<D>>();
                break;
        }
    }

    /// In the order of BroadPhaseKind.
    std::variant<BruteForce<D>, Grid<D>, LayeredGrid<D>, SweepAndPrune<D>, Bvh<D>, Bsp<D>> phase_;
    BroadPhaseHistory history_;
    std::uint32_t updates_ = 0;
};

}  // namespace abut
