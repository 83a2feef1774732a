// The tests of near pairs: early outs, contacts and impacts.

#include <abut/query/overlaps.hpp>
#include <abut/world/detail/pair_tests.hpp>

#include <algorithm>

#include <hwy/cache_control.h>

namespace abut {

/// Items are in memory by slot, and so those of a pair far apart: those of later pairs are fetched meanwhile.
template <int D>
void World<D>::PairTests::run(std::size_t begin, std::size_t end) {
    constexpr std::size_t ahead = 8, cache_line = 64;
    const bool are_cached = items_.size() <= detail::max_cached_items;
    const std::span<const detail::SlotPair> near = world_.near_;
    for (std::size_t i = begin; i < end; ++i) {
        if (!are_cached) {
            const detail::SlotPair& later = near[std::min(i + ahead, end - 1)];
            for (const std::uint32_t slot : {later.a, later.b}) {
                hwy::Prefetch(&items_[slot]);
                hwy::Prefetch(reinterpret_cast<const char*>(&items_[slot]) + cache_line);
                if (world_.filters_edges_) hwy::Prefetch(neighbours_.data(slot));
            }
            const detail::SlotPair& next = near[std::min(i + ahead / 2, end - 1)];
            for (const std::uint32_t slot : {next.a, next.b}) {
                hwy::Prefetch(items_[slot].stored.data());
                if (world_.filters_edges_) hwy::Prefetch(neighbours_.list(slot));
            }
        }
        test_pair(pair_of(near[i]));
    }
    filter_contacts();
}

/// Tests a near pair. If nothing changed, the last result is repeated.
template <int D>
inline void World<D>::PairTests::test_pair(const Pair& pair) {
    const auto& [slots, a, b] = pair;
    const auto has_changed = [](const Item& item) { return item.pending && !item.pending_in_box; };
    if (!has_changed(a) && !has_changed(b) && !world_.has_changed_near(slots.a, slots.b) &&
        !world_.has_changed_near(slots.b, slots.a) && !world_.has_new_answer(slots))
        return repeat_last(pair);
    ++results_.tested;
    set_frame(slots.a);
    // A pair may be near by its swept boxes alone; it touches only if the present boxes overlap.
    const bool touch = (!world_.widened_ || world_.are_boxes_near(slots.a, slots.b)) && test_touch(pair);
    if (a.continuous || b.continuous) test_motion(pair, touch);
}

/// Tests whether a pair touches now, with the early out by bounding balls, and adds it to results_.touching if so. The
/// first part of an update alone measures, because measurements are shared.
template <int D>
inline bool World<D>::PairTests::test_touch(const Pair& pair) {
    detail::BallEarlyOuts& early_outs = world_.ball_early_outs_;
    detail::BallEarlyOuts::Entry& entry = early_outs.entry(pair.a.type, pair.b.type, pair.has_sensor());
    const bool is_sample = is_first_part_ && early_outs.due(entry);
    BallSample sample;
    if (is_sample) {
        sample = measure_balls(pair);
    } else if (entry.is_used && balls_apart(pair)) {
        ++results_.balls;
        return false;
    }
    const bool touch = test_shapes(pair);
    if (is_sample) add_sample(entry, sample, touch);
    return touch;
}

/// Adds the impact of a pair since the last update, unless the pair touched at that update.
template <int D>
void World<D>::PairTests::test_motion(const Pair& pair, bool touch) {
    const auto& [a, b] = pair.slots;
    if (!world_.has_swept_box(a) && !world_.has_swept_box(b)) return;
    const std::vector<IdPair>& last = world_.touching_;
    const IdPair ids = pair.ids();
    if (std::binary_search(last.begin(), last.end(), ids)) return;
    const std::optional<Hit<D>> hit = world_.sweep_pair(a, b);
    if (!hit) return;
    results_.impacts.push_back({ids.a, ids.b, *hit});
    if (!touch) results_.passed.push_back(ids);
}

/// Repeats the last result of a pair of which neither item changed. Its contact is found anew if a neighbour changed.
template <int D>
void World<D>::PairTests::repeat_last(const Pair& pair) {
    const std::vector<IdPair>& last = world_.touching_;
    const IdPair ids = pair.ids();
    const auto found = std::lower_bound(last.begin(), last.end(), ids);
    if (found == last.end() || *found != ids) return;
    const auto& [slots, begin, end] = world_.results_.touching[static_cast<std::size_t>(found - last.begin())];
    const std::size_t first = results_.found.size();
    if (begin != end && world_.neighbours_changed(slots)) {
        set_frame(slots.a);
        find_contact(pair);
    } else {
        results_.found.append(world_.results_.found, begin, end);
    }
    results_.add_touching(slots, first);
}

/// Where no rotation moves the balls, as those of most shapes, their positions suffice.
template <int D>
inline bool World<D>::PairTests::balls_apart(const Pair& pair) const {
    const auto& [slots, a, b] = pair;
    if (is_large_ || !a.ball_is_centered || !b.ball_is_centered)
        return detail::apart(world_.ball(slots.a, frame_), world_.ball(slots.b, frame_));
    constexpr float rounding = 1.00001f;
    const Vec<D> between = b.pose.position - a.pose.position;
    const float reach = a.local_ball.radius + b.local_ball.radius;
    return glm::dot(between, between) > reach * reach * rounding;
}

/// Tests the shapes of a pair, and adds it to results_.touching if they touch.
template <int D>
inline bool World<D>::PairTests::test_shapes(const Pair& pair) {
    const std::size_t first = results_.found.size();
    if (pair.has_sensor()) {
        const auto [placed_a, placed_b] = placed_views(pair.slots);
        if (!overlaps(placed_a, placed_b)) return false;
    } else if (!find_contact(pair)) {
        return false;
    }
    results_.add_touching(pair.slots, first);
    return true;
}

/// Measures the test of the balls. It runs 16 times, because it takes less time than reading the clock, and once
/// before: if the early out isn't in use, the balls must be fetched from memory first.
template <int D>
typename World<D>::PairTests::BallSample World<D>::PairTests::measure_balls(const Pair& pair) const {
    BallSample result;
    result.overlap = !balls_apart(pair);
    result.clock[0] = detail::steady_nanoseconds();
    result.clock[1] = detail::steady_nanoseconds();
    for (int i = 0; i < ball_repetitions; ++i) result.overlap = !balls_apart(pair);
    result.clock[2] = detail::steady_nanoseconds();
    return result;
}

/// Adds a sample right after the test of the shapes.
template <int D>
void World<D>::PairTests::add_sample(detail::BallEarlyOuts::Entry& entry, const BallSample& sample, bool touch) {
    const std::array<std::uint64_t, 4> clock{sample.clock[0], sample.clock[1], sample.clock[2],
                                             detail::steady_nanoseconds()};
    std::array<double, 3> nanoseconds{};
    for (std::size_t i = 0; i < 3; ++i) nanoseconds[i] = static_cast<double>(clock[i + 1] - clock[i]);
    nanoseconds[1] = nanoseconds[0] + (nanoseconds[1] - nanoseconds[0]) / ball_repetitions;
    world_.ball_early_outs_.add_sample(entry, nanoseconds, sample.overlap, touch);
}

template class World<2>::PairTests;
template class World<3>::PairTests;

}  // namespace abut
