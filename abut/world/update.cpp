// The update: boxes, near pairs, contacts and events.

#include <abut/math/detail/radix_sort.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/world/detail/edge_filter_state.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <bit>

#include <hwy/cache_control.h>

namespace abut {

template <int D>
void World<D>::refresh_boxes() {
    // The running mean over 16 updates serves a game that sends its queries in every second or every tenth update.
    constexpr double averaged_updates = 16;
    queries_per_item_ += (queries_per_item(query_count_.take(query_limit())) - queries_per_item_) / averaged_updates;
    moving_.refresh(queries_per_item_);
    if (fixed_.changed()) fixed_.refresh(queries_per_fixed_item);
}

template <int D>
void World<D>::refresh_now() {
    if (moving_.changed()) moving_.refresh(queries_per_item_);
    if (fixed_.changed()) fixed_.refresh(queries_per_fixed_item);
}

/// Whether two items pair where they are near.
template <int D>
bool World<D>::may_pair(std::uint32_t slot, std::uint32_t other) const {
    return items_[slot].may_pair(items_[other]) &&
           (!pair_filter_ || pair_filter_(id_of(std::min(slot, other)), id_of(std::max(slot, other))));
}

/// Whether a pair filter has just begun to accept a near pair.
template <int D>
bool World<D>::has_new_answer(const IdPair& pair) const {
    return filters_pairs_ && !std::binary_search(last_near_.begin(), last_near_.end(), pair);
}

/// Adds a pair whose boxes in the broad phases overlap to near_, if its boxes are near.
template <int D>
void World<D>::add_if_near(std::uint32_t slot, std::uint32_t other) {
    if (widened_ && !may_touch(slot, other)) return;
    if (!may_pair(slot, other)) return;
    near_keys_.push_back(std::uint64_t{std::min(slot, other)} << slot_bits() | std::max(slot, other));
    if (!filters_edges_ || !are_neighbours(slot, other)) return;
    if (!items_[slot].fixed) edges_->count_neighbour(slot);
    if (!items_[other].fixed) edges_->count_neighbour(other);
}

/// The number of bits of a slot in near_keys_.
template <int D>
int World<D>::slot_bits() const {
    return static_cast<int>(std::bit_width(items_.size()));
}

/// Writes the near pairs in the order of their ids, and lists the neighbours of the items whose contacts are filtered.
template <int D>
void World<D>::sort_near() {
    sorted_near_keys_.reserve(near_keys_.capacity());
    sorted_near_keys_.resize(near_keys_.size());
    const int bits = slot_bits();
    const std::uint64_t* const sorted =
        detail::radix_sort(near_keys_.data(), sorted_near_keys_.data(), near_keys_.size(), 2 * bits,
                           [](std::uint64_t key) { return key; });
    std::swap(near_, last_near_);
    near_.resize(near_keys_.size());
    const std::uint64_t low_bits = (std::uint64_t{1} << bits) - 1;
    if (filters_edges_) edges_->place_neighbours();
    for (std::size_t i = 0; i < near_.size(); ++i) {
        const auto a = static_cast<std::uint32_t>(sorted[i] >> bits);
        const auto b = static_cast<std::uint32_t>(sorted[i] & low_bits);
        near_[i] = {id_of(a), id_of(b)};
        if (filters_edges_ && are_neighbours(a, b)) add_neighbours(a, b);
    }
}

/// Adds each of two items to the neighbours of the other one, if the other one's contacts are filtered.
template <int D>
void World<D>::add_neighbours(std::uint32_t slot, std::uint32_t other) {
    if (!items_[slot].fixed) edges_->add_neighbour(slot, {other, box(other)});
    if (!items_[other].fixed) edges_->add_neighbour(other, {slot, box(slot)});
}

/// Tests all near pairs. Items are in memory by slot, and so those of a pair far apart: those of later pairs are
/// fetched meanwhile.
template <int D>
void World<D>::test_near() {
    constexpr std::size_t ahead = 8, cache_line = 64;
    for (std::size_t i = 0; i < near_.size(); ++i) {
        const Item& later = items_[near_[std::min(i + ahead, near_.size() - 1)].b.index - 1];
        hwy::Prefetch(&later);
        hwy::Prefetch(reinterpret_cast<const char*>(&later) + cache_line);
        test_pair(near_[i]);
    }
}

/// Tests a near pair. If nothing changed, the last result is repeated.
template <int D>
void World<D>::test_pair(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    if (!a.pending && !b.pending && !has_new_answer(pair)) return repeat_last(pair);
    ++counts_.tested;
    // A pair may be near by its swept boxes alone; it touches only if the present boxes overlap.
    const bool touch = (!widened_ || overlaps(box(pair.a.index - 1), box(pair.b.index - 1))) && test_touch(pair);
    if (a.continuous || b.continuous) test_motion(pair, touch);
}

/// Tests whether a pair touches now, with the early out by bounding balls, and adds it to touching_ if so.
template <int D>
bool World<D>::test_touch(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    detail::BallEarlyOuts::Entry& entry = ball_early_outs_.entry(a.type, b.type, a.sensor || b.sensor);
    if (ball_early_outs_.due(entry)) return measure(pair, entry);
    if (!ball_early_outs_.is_used(entry) || !balls_apart(pair)) return test_shapes(pair);
    ++counts_.balls;
    return false;
}

/// Repeats the last result of a pair of which neither item changed. Its contact is found anew if a neighbour changed.
template <int D>
void World<D>::repeat_last(const IdPair& pair) {
    if (!std::binary_search(last_touching_.begin(), last_touching_.end(), pair)) return;
    touching_.push_back(pair);
    const std::span<const WorldContact<D>> all = last_found_.contacts, found = detail::entries_of(all, pair);
    if (found.empty()) return;
    if (neighbours_changed(pair)) {
        find_contact(pair);
        return;
    }
    for (const WorldContact<D>& contact : found) {
        const detail::FoundState& last = last_found_.states[static_cast<std::size_t>(&contact - all.data())];
        found_.add(pair, last) = contact;
        if (last.own_area != detail::FoundState::no_own_area)
            found_.set_own_area(found_.size() - 1, last_found_.own_areas[last.own_area]);
    }
}

template <int D>
bool World<D>::balls_apart(const IdPair& pair) const {
    return detail::apart(ball(items_[pair.a.index - 1]), ball(items_[pair.b.index - 1]));
}

template <int D>
const View<D>& World<D>::first_placed(std::uint32_t slot) {
    if (first_.slot != slot) {
        first_.slot = slot;
        std::construct_at(&first_.view, placed(items_[slot]));
    }
    return first_.view;
}

/// Tests the shapes of a pair, and adds it to touching_ if they touch.
template <int D>
bool World<D>::test_shapes(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    if (a.sensor || b.sensor) {
        if (!overlaps(first_placed(pair.a.index - 1), placed_view(pair.b.index - 1))) return false;
    } else if (!find_contact(pair)) {
        return false;
    }
    touching_.push_back(pair);
    return true;
}

/// Measures the tests of the balls and of the shapes. The test of the balls runs 16 times, because it takes less time
/// than reading the clock, and once before: if the early out isn't in use, the balls must be fetched from memory first.
template <int D>
bool World<D>::measure(const IdPair& pair, detail::BallEarlyOuts::Entry& entry) {
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
    ball_early_outs_.add_sample(entry, nanoseconds, overlap, touch);
    return touch;
}

template <int D>
void World<D>::compare_with_last() {
    began_.clear();
    stayed_.clear();
    ended_.clear();
    auto now = touching_.begin();
    auto then = last_touching_.begin();
    while (now != touching_.end() || then != last_touching_.end()) {
        if (then == last_touching_.end() || (now != touching_.end() && *now < *then)) {
            began_.push_back(*now++);
        } else if (now == touching_.end() || *then < *now) {
            ended_.push_back(*then++);
        } else {
            stayed_.push_back(*now++);
            ++then;
        }
    }
    // The lists share no pair: a pair in passed_ touches neither now nor at the last update.
    const auto add = [](const std::vector<IdPair>& passed, std::vector<IdPair>& list) {
        if (passed.empty()) return;
        list.insert(list.end(), passed.begin(), passed.end());
        std::sort(list.begin(), list.end());
    };
    add(passed_, began_);
    add(last_passed_, ended_);
    set_fractions();
}

template <int D>
Events World<D>::find_events() {
    widen_boxes();
    refresh_boxes();

    near_keys_.clear();
    if (filters_edges_) {
        if (edges_ == nullptr) edges_.reset(new detail::EdgeFilterState<D>());
        edges_->begin_update(items_.size());
    }
    moving_.phase().each_pair(
        [this](std::uint32_t i, std::uint32_t j) { add_if_near(moving_.slot(i), moving_.slot(j)); });
    moving_.phase().each_overlapping_pair(
        fixed_.phase(), [this](std::uint32_t i, std::uint32_t j) { add_if_near(moving_.slot(i), fixed_.slot(j)); });
    sort_near();

    std::swap(touching_, last_touching_);
    std::swap(found_, last_found_);
    std::swap(passed_, last_passed_);
    touching_.clear();
    found_.clear();
    passed_.clear();
    impacts_.clear();
    views_.clear();
    first_.slot = none;
    counts_ = {near_.size(), 0, 0};
    test_near();
    filter_contacts();
    report_contacts();
    ball_early_outs_.decide();
    // Reserve for the worst case of a scene of this size: the lists are swapped, and all pairs may begin, stay or end.
    const std::size_t capacity = std::max(touching_.capacity(), last_touching_.capacity());
    for (std::vector<IdPair>* list : {&last_touching_, &touching_, &stayed_}) list->reserve(capacity);
    for (std::vector<IdPair>* list : {&passed_, &last_passed_}) list->reserve(impacts_.capacity());
    for (std::vector<IdPair>* list : {&began_, &ended_}) list->reserve(capacity + impacts_.capacity());
    fractions_.reserve(began_.capacity());
    last_found_.reserve_like(found_);
    contacts_.reserve(found_.contacts.capacity());
    last_near_.reserve(near_.capacity());
    reserve_edge_filter();
    compare_with_last();
    pair_index_.build(touching_, capacity);

    for (const std::uint32_t slot : pending_) {
        items_[slot].pending = false;
        items_[slot].settled = true;
        items_[slot].previous = none;
    }
    pending_.clear();
    previous_poses_.clear();
    swept_boxes_.clear();
    filters_pairs_ = pair_filter_ != nullptr;
    return {began_, stayed_, ended_, fractions_};
}

template class World<2>;
template class World<3>;

}  // namespace abut
