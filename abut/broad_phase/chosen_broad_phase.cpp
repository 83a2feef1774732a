#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <array>
#include <type_traits>

namespace abut {

using namespace detail;

namespace {

/// The time of an overlap query of each structure, as a multiple of that of a tree, in the order of BroadPhaseKind;
/// docs/broad_phases.md has the row.
constexpr std::array<double, 6> overlap_query_cost{1, 2, 11, 2, 1, 8};

/// Whether it is faster to query the second structure with the boxes of the first than the reverse.
bool first_queries_second(std::size_t count, BroadPhaseKind kind, std::size_t other_count, BroadPhaseKind other_kind) {
    const auto cost = [](std::size_t queries, BroadPhaseKind queried) {
        return static_cast<double>(queries) * overlap_query_cost[static_cast<std::size_t>(queried)];
    };
    return cost(count, other_kind) <= cost(other_count, kind);
}

}  // namespace

template <int D>
void ChosenBroadPhase<D>::become(BroadPhaseKind kind) {
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

template <int D>
BroadPhaseKind ChosenBroadPhase<D>::choose(std::span<const Aabb<D>> boxes) const {
    return always_ ? *always_ : choose_broad_phase<D>(boxes, history_);
}

template <int D>
void ChosenBroadPhase<D>::build(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    const BroadPhaseKind chosen = choose(boxes);
    if (chosen != kind()) become(chosen);
    updates_ = 0;
    chosen_queries_ = history_.queries;
    std::visit([&](auto& phase) { phase.build(boxes, executor); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    constexpr std::uint32_t updates_per_choice = 64;
    // Rates far below 0.01 queries per box count as equal.
    constexpr double max_ratio = 2, offset = 0.01;
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) return build(boxes, executor);
    const double now = history_.queries + offset, then = chosen_queries_ + offset;
    const bool rate_changed = now > max_ratio * then || then > max_ratio * now;
    if (++updates_ % updates_per_choice == 0 || rate_changed) {
        chosen_queries_ = history_.queries;
        if (choose(boxes) != kind()) return build(boxes, executor);
    }
    std::visit([&](auto& phase) { phase.update(boxes, executor); }, phase_);
}

template <int D>
bool ChosenBroadPhase<D>::grow() {
    return std::visit(
        [](auto& phase) {
            if constexpr (requires { phase.insert(Aabb<D>()); }) {
                phase.insert(Aabb<D>::empty());
                return true;
            }
            return false;
        },
        phase_);
}

template <int D>
bool ChosenBroadPhase<D>::set(std::uint32_t index, const Aabb<D>& box) {
    detail::enter_library();
    return std::visit(
        [&](auto& phase) {
            if constexpr (requires { phase.set(index, box); }) return phase.set(index, box);
            return false;
        },
        phase_);
}

template <int D>
void ChosenBroadPhase<D>::refit(std::span<const Aabb<D>> boxes) {
    std::visit([&](auto& phase) { phase.update(boxes); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::set_history(const BroadPhaseHistory& history) {
    detail::enter_library();
    history_ = history;
}

template <int D>
std::size_t ChosenBroadPhase<D>::size() const {
    return std::visit([](const auto& phase) { return phase.size(); }, phase_);
}

template <int D>
Aabb<D> ChosenBroadPhase<D>::bounds() const {
    detail::enter_library();
    return std::visit([](const auto& phase) { return phase.bounds(); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    std::visit([&](const auto& phase) { phase.each_pair(visit, executor); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_pairs(const ChosenBroadPhase& other, PairsCall visit) const {
    const auto visit_between = [&]<class A, class B>(const A& own, const B& others) {
        if constexpr (std::is_same_v<A, B>)
            own.each_overlapping_pair(others, visit);
        else if (first_queries_second(size(), kind(), other.size(), other.kind()))
            detail::report_between(own, others, visit);
        else
            detail::report_between(others, own, visit, true);
    };
    std::visit(visit_between, phase_, other.phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_boxes(BoxCall<D> visit) const {
    std::visit([&](const auto& phase) { phase.each_box(visit); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    std::visit([&](const auto& phase) { phase.each_overlapping(box, visit); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    std::visit([&](const auto& phase) { phase.raycast(ray, visit); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    std::visit([&](const auto& phase) { phase.sweep(box, visit); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    std::visit([&](const auto& phase) { phase.closest(box, visit, reach); }, phase_);
}

template class ChosenBroadPhase<2>;
template class ChosenBroadPhase<3>;
static_assert(BroadPhase<ChosenBroadPhase<2>, 2> && BroadPhase<ChosenBroadPhase<3>, 3>);

}  // namespace abut
