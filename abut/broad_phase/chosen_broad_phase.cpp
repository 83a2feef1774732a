#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/pair_buffer.hpp>

#include <array>
#include <type_traits>

namespace abut {
namespace {

/// What to ask a structure for what overlaps a box takes, as a multiple of what it takes a tree: docs/broad_phases.md
/// has the row. In the order of BroadPhaseKind.
constexpr std::array<double, 6> region_cost{1, 2, 11, 2, 1, 8};

/// Whether the boxes of the first are to be asked for in the second, or the other way round: what takes less.
bool first_asks(std::size_t count, BroadPhaseKind kind, std::size_t other_count, BroadPhaseKind other_kind) {
    const auto cost = [](std::size_t questions, BroadPhaseKind asked) {
        return static_cast<double>(questions) * region_cost[static_cast<std::size_t>(asked)];
    };
    return cost(count, other_kind) <= cost(other_count, kind);
}

/// Calls told(item of the asking, item of the asked) for what overlaps; false stops.
template <class Asking, class Asked, class Told>
void ask_for_each(const Asking& asking, const Asked& asked, Told told) {
    asking.each_box([&](std::uint32_t i, const auto& box) {
        bool go_on = true;
        asked.each_overlapping(box, [&](std::uint32_t j) { return go_on = told(i, j); });
        return go_on;
    });
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
BroadPhaseKind ChosenBroadPhase<D>::wanted(std::span<const Aabb<D>> boxes) const {
    return always_ ? *always_ : choose_broad_phase<D>(boxes, history_);
}

template <int D>
void ChosenBroadPhase<D>::build(std::span<const Aabb<D>> boxes, Executor* executor) {
    const BroadPhaseKind kind_wanted = wanted(boxes);
    if (kind_wanted != kind()) become(kind_wanted);
    updates_ = 0;
    asked_ = history_.asked;
    std::visit([&](auto& phase) { phase.build(boxes, executor); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    constexpr std::uint32_t between = 64;
    // A hundredth part of a question a box is next to none.
    constexpr double unlike = 2, few = 0.01;
    if (boxes.size() != size()) return build(boxes, executor);
    const double now = history_.asked + few, then = asked_ + few;
    const bool asked_otherwise = now > unlike * then || then > unlike * now;
    if (++updates_ % between == 0 || asked_otherwise) {
        asked_ = history_.asked;
        if (wanted(boxes) != kind()) return build(boxes, executor);
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
void ChosenBroadPhase<D>::tell(const BroadPhaseHistory& history) {
    history_ = history;
}

template <int D>
std::size_t ChosenBroadPhase<D>::size() const {
    return std::visit([](const auto& phase) { return phase.size(); }, phase_);
}

template <int D>
Aabb<D> ChosenBroadPhase<D>::bounds() const {
    return std::visit([](const auto& phase) { return phase.bounds(); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    std::visit([&](const auto& phase) { phase.each_pair(visit, executor); }, phase_);
}

template <int D>
void ChosenBroadPhase<D>::visit_pairs(const ChosenBroadPhase& other, PairsCall visit) const {
    const auto meet = [&]<class A, class B>(const A& ours, const B& theirs) {
        if constexpr (std::is_same_v<A, B>) {
            ours.each_overlapping_pair(theirs, visit);
        } else {
            PairBuffer pairs(visit);
            bool go_on = true;
            if (first_asks(size(), kind(), other.size(), other.kind()))
                ask_for_each(ours, theirs, [&](std::uint32_t i, std::uint32_t j) { return go_on = pairs.add(i, j); });
            else
                ask_for_each(theirs, ours, [&](std::uint32_t j, std::uint32_t i) { return go_on = pairs.add(i, j); });
            if (go_on) pairs.flush();
        }
    };
    std::visit(meet, phase_, other.phase_);
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
