// The update: boxes, near pairs, contacts and events.

#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/math/detail/mutex.hpp>
#include <abut/math/detail/radix_sort.hpp>
#include <abut/world/detail/pair_tests.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <array>
#include <bit>

#include <hwy/cache_control.h>

namespace abut {

template <int D>
void World<D>::refresh_boxes(Executor* executor) {
    // The running mean over 16 updates serves a game that sends its queries in every second or every tenth update.
    constexpr double averaged_updates = 16;
    queries_per_item_ += (queries_per_item(query_count_.take(query_limit())) - queries_per_item_) / averaged_updates;
    moving_.refresh(queries_per_item_, executor);
    if (fixed_.changed()) fixed_.refresh(queries_per_fixed_item, executor);
}

template <int D>
void World<D>::refresh_now() {
    if (positions_.are_far()) set_boxes();
    if (moving_.changed()) moving_.refresh(queries_per_item_);
    if (fixed_.changed()) fixed_.refresh(queries_per_fixed_item);
}

/// Whether two items pair where they are near.
template <int D>
inline bool World<D>::may_pair(std::uint32_t slot, std::uint32_t other) const {
    return items_[slot].may_pair(items_[other]) &&
           (!pair_filter_ || pair_filter_(id_of(std::min(slot, other)), id_of(std::max(slot, other))));
}

/// Whether an item has changed where another one is, or near: the filter of internal edges looks no farther than 0.01
/// of a radius beyond the smaller of two items.
template <int D>
bool World<D>::has_changed_near(std::uint32_t slot, std::uint32_t other) const {
    if (!items_[slot].pending || !items_[slot].pending_in_box) return items_[slot].pending;
    constexpr float reach = 1.0f / 64;
    const Aabb<D> near = box_about(other, positions_.frame(slot));
    const auto of_slot = std::find_if(changed_boxes_.begin(), changed_boxes_.end(),
                                      [slot](const auto& changed) { return changed.first == slot; });
    return overlaps(of_slot->second, grown(near, reach * length(near.max - near.min)));
}

/// Whether a pair filter has just begun to accept a near pair.
template <int D>
bool World<D>::has_new_answer(const detail::SlotPair& pair) const {
    return filters_pairs_ && !std::binary_search(last_near_.begin(), last_near_.end(), pair);
}

/// Whether both items of a near pair are part of the surface that a third one touches. Sensors are not, and near by
/// their swept boxes alone is not enough.
template <int D>
bool World<D>::are_neighbours(std::uint32_t slot, std::uint32_t other) const {
    return !items_[slot].sensor && !items_[other].sensor && (!widened_ || are_boxes_near(slot, other));
}

/// Finds the near pairs, in the order of the broad phases: those of one place lie together, and so their items are in
/// the caches when they are tested. The threads of an executor report pairs at the same time.
template <int D>
void World<D>::find_near(Executor* executor) {
    std::swap(near_, last_near_);
    near_.clear();
    if (filters_edges_) memory_->neighbours.begin_update(items_.size());
    // Whether the broad phases hold boxes that are larger than those of the items.
    const bool is_large = positions_.are_used(), is_wider = widened_ || is_large;
    const bool are_cached = items_.size() <= detail::max_cached_items;
    detail::Mutex mutex;
    const auto add = [&](const detail::ItemBoxes<D>& first, const detail::ItemBoxes<D>& second,
                         std::span<const detail::ItemPair> pairs) {
        constexpr std::size_t batch = 64;
        const std::uint32_t second_is_fixed = &second == &fixed_;
        while (!pairs.empty()) {
            std::array<detail::SlotPair, batch> found;
            std::array<detail::NeighbourPair, batch> neighbours;
            std::size_t count = 0, neighbour_count = 0;
            const std::span next = pairs.first(std::min(batch, pairs.size()));
            if (!are_cached)
                for (const auto& [i, j] : next) {
                    hwy::Prefetch(&items_[first.slot(i)].mask);
                    hwy::Prefetch(&items_[second.slot(j)].mask);
                }
            for (const auto& [i, j] : next) {
                const std::uint32_t slot = first.slot(i), other = second.slot(j);
                const bool are_near =
                    !is_wider || (is_large && detail::DoublePositions<D>::surely_overlap(first.box(i), second.box(j)));
                if ((!are_near && !may_touch(slot, other)) || !may_pair(slot, other)) continue;
                found[count++] = {std::min(slot, other), std::max(slot, other)};
                if (!filters_edges_) continue;
                neighbours[neighbour_count] = {{{{slot, i, 0}, {other, j, second_is_fixed}}}};
                neighbour_count += are_neighbours(slot, other);
            }
            pairs = pairs.subspan(next.size());
            const detail::Lock lock(mutex);
            near_.insert(near_.end(), found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
            memory_->neighbours.add(std::span(neighbours).first(neighbour_count));
        }
        return true;
    };
    moving_.phase().each_pair(
        detail::PairsCall([&](std::span<const detail::ItemPair> pairs) { return add(moving_, moving_, pairs); }),
        executor);
    moving_.phase().each_overlapping_pair(
        fixed_.phase(),
        detail::PairsCall([&](std::span<const detail::ItemPair> pairs) { return add(moving_, fixed_, pairs); }));
    if (filters_pairs_)
        for (std::vector<detail::SlotPair>* pairs : {&near_, &last_near_})
            if (!std::is_sorted(pairs->begin(), pairs->end())) std::sort(pairs->begin(), pairs->end());
}

/// Tests all near pairs, with an executor in parts. Meanwhile results_ are those of the last update.
template <int D>
void World<D>::test_near(Executor* executor) {
    constexpr std::size_t min_part = 64, parts_per_worker = 8;
    detail::UpdateState<D>& state = *memory_;
    const std::size_t workers = executor != nullptr ? executor->workers() : 1;
    const std::size_t parts =
        workers == 1 ? 1 : std::clamp<std::size_t>(near_.size() / min_part, 1, parts_per_worker * workers);
    if (state.memories.size() < workers) state.memories.resize(workers);
    if (state.parts.size() < parts) state.parts.resize(parts);
    state.free_memories.clear();
    for (std::uint32_t i = 0; i < state.memories.size(); ++i) {
        state.memories[i].clear(positions_.are_used());
        state.free_memories.push_back(i);
    }
    detail::Mutex mutex;
    const auto test_part = [&](std::uint32_t part) {
        const auto take = [&] {
            const detail::Lock lock(mutex);
            const std::uint32_t memory = state.free_memories.back();
            state.free_memories.pop_back();
            return memory;
        };
        const std::uint32_t memory = take();
        const std::size_t begin = near_.size() * part / parts, end = near_.size() * (part + 1) / parts;
        detail::PairResults<D>& stored = state.parts[part];
        // On the stack, off the cache lines that other threads use.
        detail::PairResults<D> results = std::move(stored);
        results.clear();
        if (parts > 1) results.reserve(end - begin);
        PairTests(*this, state.memories[memory], results, part == 0).run(begin, end);
        stored = std::move(results);
        const detail::Lock lock(mutex);
        state.free_memories.push_back(memory);
    };
    detail::run_parallel(executor, static_cast<std::uint32_t>(parts), test_part);
    join_results(std::span(state.parts).first(parts));
}

/// Joins what the parts found. All but the contacts is sorted.
template <int D>
void World<D>::join_results(std::span<detail::PairResults<D>> parts) {
    for (const detail::PairResults<D>& part : parts.subspan(1)) parts.front().append(part);
    std::swap(results_, parts.front());
    std::swap(parts.front().passed, last_passed_);

    std::vector<detail::TouchingSlots>&touching = results_.touching, &other = memory_->unsorted;
    const int bits = static_cast<int>(std::bit_width(items_.size()));
    const auto key = [bits](const detail::TouchingSlots& touch) {
        return std::uint64_t{touch.slots.a} << bits | touch.slots.b;
    };
    other.reserve(touching.capacity());
    other.resize(touching.size());
    if (detail::radix_sort(touching.data(), other.data(), touching.size(), 2 * bits, key) == other.data())
        std::swap(touching, other);
    std::sort(results_.passed.begin(), results_.passed.end());
    std::sort(results_.impacts.begin(), results_.impacts.end(),
              [](const WorldImpact<D>& first, const WorldImpact<D>& second) {
                  return IdPair{first.a, first.b} < IdPair{second.a, second.b};
              });
}

template <int D>
void World<D>::compare_with_last() {
    began_.clear();
    ended_.clear();
    stayed_.resize(std::min(touching_.size(), last_touching_.size()));
    auto now = touching_.begin(), then = last_touching_.begin(), stayed = stayed_.begin();
    while (now != touching_.end() && then != last_touching_.end()) {
        if (*now == *then) {
            *stayed++ = *now++;
            ++then;
        } else if (*now < *then) {
            began_.push_back(*now++);
        } else {
            ended_.push_back(*then++);
        }
    }
    stayed_.erase(stayed, stayed_.end());
    began_.insert(began_.end(), now, touching_.end());
    ended_.insert(ended_.end(), then, last_touching_.end());
    // The lists share no pair: a pair in results_.passed touches neither now nor at the last update.
    const auto add = [](const std::vector<IdPair>& passed, std::vector<IdPair>& list) {
        if (passed.empty()) return;
        list.insert(list.end(), passed.begin(), passed.end());
        std::sort(list.begin(), list.end());
    };
    add(results_.passed, began_);
    add(last_passed_, ended_);
    set_fractions();
}

template <int D>
Events World<D>::find_events(Executor* executor) {
    if (positions_.are_far()) set_boxes();
    widen_boxes();
    refresh_boxes(executor);

    if (memory_ == nullptr) memory_.reset(new detail::UpdateState<D>());
    memory_->find_neighbour_changed.defer();
    find_near(executor);
    if (filters_edges_) memory_->neighbours.make_lists({moving_.boxes(), fixed_.boxes()});

    test_near(executor);
    counts_ = {near_.size(), results_.tested, results_.balls};
    list_results();
    ball_early_outs_.decide();
    // Reserve for the worst case of a scene of this size: the lists are swapped, and all pairs may begin, stay or end.
    const std::size_t capacity = std::max(touching_.capacity(), last_touching_.capacity());
    for (std::vector<IdPair>* list : {&last_touching_, &touching_, &stayed_}) list->reserve(capacity);
    for (std::vector<IdPair>* list : {&results_.passed, &last_passed_}) list->reserve(results_.impacts.capacity());
    for (std::vector<IdPair>* list : {&began_, &ended_}) list->reserve(capacity + results_.impacts.capacity());
    fractions_.reserve(began_.capacity());
    results_.reserve_like(results_);                // states may be fewer than contacts
    memory_->parts.front().reserve_like(results_);  // the two are swapped
    contacts_.reserve(results_.found.contacts.capacity());
    last_near_.reserve(near_.capacity());
    memory_->reserve(filters_edges_ ? items_.size() : 0, near_.capacity(), results_.found.contacts.capacity());
    compare_with_last();
    pair_index_.defer(capacity);

    for (const std::uint32_t slot : pending_) {
        items_[slot].pending = items_[slot].pending_in_box = false;
        items_[slot].settled = true;
        items_[slot].previous = none;
    }
    pending_.clear();
    changed_boxes_.clear();
    previous_poses_.clear();
    positions_.clear_previous();
    swept_boxes_.clear();
    filters_pairs_ = pair_filter_ != nullptr;
    return {began_, stayed_, ended_, fractions_};
}

template <int D>
void detail::DeleteUpdateState<D>::operator()(UpdateState<D>* state) const {
    delete state;
}

template struct detail::DeleteUpdateState<2>;
template struct detail::DeleteUpdateState<3>;
template class World<2>;
template class World<3>;

}  // namespace abut
