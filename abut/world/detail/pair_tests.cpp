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
    for (std::size_t i = begin; i < end; ++i) {
        if (!are_cached) {
            const detail::SlotPair& later = world_.near_[std::min(i + ahead, end - 1)];
            for (const std::uint32_t slot : {later.a, later.b}) {
                hwy::Prefetch(&items_[slot]);
                hwy::Prefetch(reinterpret_cast<const char*>(&items_[slot]) + cache_line);
                if (world_.filters_edges_) hwy::Prefetch(neighbours_.data(slot));
            }
            const detail::SlotPair& next = world_.near_[std::min(i + ahead / 2, end - 1)];
            for (const std::uint32_t slot : {next.a, next.b}) {
                hwy::Prefetch(items_[slot].stored.data());
                if (world_.filters_edges_) hwy::Prefetch(neighbours_.list(slot));
            }
        }
        test_pair(world_.near_[i]);
    }
    filter_contacts();
}

/// Tests a near pair. If nothing changed, the last result is repeated.
template <int D>
inline void World<D>::PairTests::test_pair(const detail::SlotPair& near) {
    const Item &a = items_[near.a], &b = items_[near.b];
    const IdPair pair{world_.id_of(near.a), world_.id_of(near.b)};
    if (!world_.has_changed_near(near.a, near.b) && !world_.has_changed_near(near.b, near.a) &&
        !world_.has_new_answer(near))
        return repeat_last(pair);
    ++results_.tested;
    set_frame(near.a);
    // A pair may be near by its swept boxes alone; it touches only if the present boxes overlap.
    const bool touch = (!world_.widened_ || world_.are_boxes_near(near.a, near.b)) && test_touch(pair);
    if (a.continuous || b.continuous) test_motion(pair, touch);
}

/// Tests whether a pair touches now, with the early out by bounding balls, and adds it to results_.touching if so. The
/// first part of an update alone measures, because measurements are shared.
template <int D>
inline bool World<D>::PairTests::test_touch(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    detail::BallEarlyOuts::Entry& entry = world_.ball_early_outs_.entry(a.type, b.type, a.sensor || b.sensor);
    if (is_first_part_ && world_.ball_early_outs_.due(entry)) return measure(pair, entry);
    if (!world_.ball_early_outs_.is_used(entry) || !balls_apart(pair)) return test_shapes(pair);
    ++results_.balls;
    return false;
}

/// Adds the impact of a pair since the last update, unless the pair touched at that update.
template <int D>
void World<D>::PairTests::test_motion(const IdPair& pair, bool touch) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    if (!world_.has_swept_box(a) && !world_.has_swept_box(b)) return;
    const std::vector<IdPair>& last = world_.touching_;
    if (std::binary_search(last.begin(), last.end(), pair)) return;
    const std::optional<Hit<D>> hit = world_.sweep_pair(a, b);
    if (!hit) return;
    results_.impacts.push_back({pair.a, pair.b, *hit});
    if (!touch) results_.passed.push_back(pair);
}

/// Repeats the last result of a pair of which neither item changed. Its contact is found anew if a neighbour changed.
template <int D>
void World<D>::PairTests::repeat_last(const IdPair& pair) {
    const std::vector<IdPair>& last = world_.touching_;
    const auto found = std::lower_bound(last.begin(), last.end(), pair);
    if (found == last.end() || *found != pair) return;
    const auto& [slots, begin, end] = world_.results_.touching[static_cast<std::size_t>(found - last.begin())];
    const std::size_t first = results_.found.size();
    if (begin != end && world_.neighbours_changed(pair)) {
        set_frame(slots.a);
        find_contact(pair);
    } else {
        results_.found.append(world_.results_.found, begin, end);
    }
    results_.add_touching(slots, first);
}

template <int D>
bool World<D>::PairTests::balls_apart(const IdPair& pair) const {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    // Most shapes lie about the origin of their own frame, and no rotation moves their ball.
    if (!is_large_ && a.local_ball.center == Vec<D>(0.0f) && b.local_ball.center == Vec<D>(0.0f)) {
        constexpr float rounding = 1.00001f;
        const Vec<D> between = b.pose.position - a.pose.position;
        const float reach = a.local_ball.radius + b.local_ball.radius;
        return glm::dot(between, between) > reach * reach * rounding;
    }
    return detail::apart(world_.ball(pair.a.index - 1, frame_), world_.ball(pair.b.index - 1, frame_));
}

/// Tests the shapes of a pair, and adds it to results_.touching if they touch.
template <int D>
inline bool World<D>::PairTests::test_shapes(const IdPair& pair) {
    const detail::SlotPair slots{pair.a.index - 1, pair.b.index - 1};
    const std::size_t first = results_.found.size();
    if (items_[slots.a].sensor || items_[slots.b].sensor) {
        const auto [placed_a, placed_b] = placed_views(pair);
        if (!overlaps(placed_a, placed_b)) return false;
    } else if (!find_contact(pair)) {
        return false;
    }
    results_.add_touching(slots, first);
    return true;
}

/// Measures the tests of the balls and of the shapes. The test of the balls runs 16 times, because it takes less time
/// than reading the clock, and once before: if the early out isn't in use, the balls must be fetched from memory first.
template <int D>
bool World<D>::PairTests::measure(const IdPair& pair, detail::BallEarlyOuts::Entry& entry) {
    constexpr int repetitions = 16;
    bool overlap = !balls_apart(pair);
    std::array<std::uint64_t, 4> clock{};
    clock[0] = detail::steady_nanoseconds();
    clock[1] = detail::steady_nanoseconds();
    for (int i = 0; i < repetitions; ++i) overlap = !balls_apart(pair);
    clock[2] = detail::steady_nanoseconds();
    const bool touch = test_shapes(pair);
    clock[3] = detail::steady_nanoseconds();
    std::array<double, 3> nanoseconds{};
    for (std::size_t i = 0; i < 3; ++i) nanoseconds[i] = static_cast<double>(clock[i + 1] - clock[i]);
    nanoseconds[1] = nanoseconds[0] + (nanoseconds[1] - nanoseconds[0]) / repetitions;
    world_.ball_early_outs_.add_sample(entry, nanoseconds, overlap, touch);
    return touch;
}

template class World<2>::PairTests;
template class World<3>::PairTests;

}  // namespace abut
