// The update: boxes, near pairs, contacts and events.

#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/math/detail/radix_sort.hpp>
#include <abut/world/detail/pair_tests.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <mutex>

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

/// Finds the near pairs, in any order. The threads of an executor report pairs at the same time.
template <int D>
void World<D>::find_near(Executor* executor) {
    near_keys_.clear();
    std::mutex mutex;
    const int bits = slot_bits();
    const auto add = [&](const detail::ItemBoxes<D>& first, const detail::ItemBoxes<D>& second,
                         std::span<const detail::ItemPair> pairs) {
        constexpr std::size_t batch = 64;
        while (!pairs.empty()) {
            std::array<std::uint64_t, batch> keys;
            std::size_t count = 0;
            for (const auto& [i, j] : pairs.first(std::min(batch, pairs.size()))) {
                const std::uint32_t slot = first.slot(i), other = second.slot(j);
                if ((widened_ && !may_touch(slot, other)) || !may_pair(slot, other)) continue;
                keys[count++] = std::uint64_t{std::min(slot, other)} << bits | std::max(slot, other);
            }
            pairs = pairs.subspan(std::min(batch, pairs.size()));
            const std::lock_guard lock(mutex);
            near_keys_.insert(near_keys_.end(), keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(count));
        }
        return true;
    };
    moving_.phase().each_pair(
        detail::PairsCall([&](std::span<const detail::ItemPair> pairs) { return add(moving_, moving_, pairs); }),
        executor);
    moving_.phase().each_overlapping_pair(
        fixed_.phase(),
        detail::PairsCall([&](std::span<const detail::ItemPair> pairs) { return add(moving_, fixed_, pairs); }));
}

/// The number of bits of a slot in near_keys_.
template <int D>
int World<D>::slot_bits() const {
    return static_cast<int>(std::bit_width(items_.size()));
}

/// Writes the near pairs in the order of their ids.
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
    for (std::size_t i = 0; i < near_.size(); ++i)
        near_[i] = {id_of(static_cast<std::uint32_t>(sorted[i] >> bits)),
                    id_of(static_cast<std::uint32_t>(sorted[i] & low_bits))};
}

/// Lists the neighbours of the items whose contacts are filtered.
template <int D>
void World<D>::list_neighbours() {
    detail::Neighbourhoods<D>& neighbours = memory_->neighbours;
    neighbours.begin_update(items_.size());
    const auto each_neighbour = [&](const auto& visit) {
        for (const IdPair& pair : near_) {
            const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
            if (!are_neighbours(a, b)) continue;
            if (!items_[a].fixed) visit(a, b);
            if (!items_[b].fixed) visit(b, a);
        }
    };
    each_neighbour([&](std::uint32_t slot, std::uint32_t) { neighbours.count(slot); });
    neighbours.place();
    each_neighbour([&](std::uint32_t slot, std::uint32_t other) { neighbours.add(slot, {other, box(other)}); });
}

/// Tests all near pairs: with an executor in parts, whose results are joined in the order of the pairs.
template <int D>
void World<D>::test_near(Executor* executor) {
    constexpr std::size_t min_part = 64, parts_per_worker = 8;
    detail::UpdateState<D>& state = *memory_;
    const std::size_t workers = executor != nullptr ? executor->workers() : 1;
    const std::size_t parts =
        workers == 1 ? 1 : std::clamp<std::size_t>(near_.size() / min_part, 1, parts_per_worker * workers);
    if (state.memories.size() < workers) state.memories.resize(workers);
    if (state.later_parts.size() + 1 < parts) state.later_parts.resize(parts - 1);
    state.free_memories.clear();
    for (std::uint32_t i = 0; i < state.memories.size(); ++i) {
        state.memories[i].clear();
        state.free_memories.push_back(i);
    }
    std::mutex mutex;
    const auto test_part = [&](std::uint32_t part) {
        const auto take = [&] {
            const std::lock_guard lock(mutex);
            const std::uint32_t memory = state.free_memories.back();
            state.free_memories.pop_back();
            return memory;
        };
        const std::uint32_t memory = take();
        const std::size_t begin = near_.size() * part / parts, end = near_.size() * (part + 1) / parts;
        detail::PairResults<D>& stored = part == 0 ? results_ : state.later_parts[part - 1];
        // On the stack, off the cache lines that other threads use.
        detail::PairResults<D> results = std::move(stored);
        results.clear();
        if (part > 0) results.reserve(end - begin);
        PairTests(*this, state.memories[memory], results, part == 0).run(begin, end);
        stored = std::move(results);
        const std::lock_guard lock(mutex);
        state.free_memories.push_back(memory);
    };
    detail::run_parallel(executor, static_cast<std::uint32_t>(parts), test_part);
    for (const detail::PairResults<D>& later : std::span(state.later_parts).first(parts - 1)) results_.append(later);
}

template <int D>
void World<D>::compare_with_last() {
    began_.clear();
    stayed_.clear();
    ended_.clear();
    auto now = results_.touching.begin();
    auto then = last_touching_.begin();
    while (now != results_.touching.end() || then != last_touching_.end()) {
        if (then == last_touching_.end() || (now != results_.touching.end() && *now < *then)) {
            began_.push_back(*now++);
        } else if (now == results_.touching.end() || *then < *now) {
            ended_.push_back(*then++);
        } else {
            stayed_.push_back(*now++);
            ++then;
        }
    }
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
    widen_boxes();
    refresh_boxes(executor);

    if (memory_ == nullptr) memory_.reset(new detail::UpdateState<D>());
    memory_->find_neighbour_changed.defer();
    find_near(executor);
    sort_near();
    if (filters_edges_) list_neighbours();

    std::swap(results_.touching, last_touching_);
    std::swap(results_.found, last_found_);
    std::swap(results_.passed, last_passed_);
    test_near(executor);
    counts_ = {near_.size(), results_.tested, results_.balls};
    report_contacts();
    ball_early_outs_.decide();
    // Reserve for the worst case of a scene of this size: the lists are swapped, and all pairs may begin, stay or end.
    const std::size_t capacity = std::max(results_.touching.capacity(), last_touching_.capacity());
    for (std::vector<IdPair>* list : {&last_touching_, &results_.touching, &stayed_}) list->reserve(capacity);
    for (std::vector<IdPair>* list : {&results_.passed, &last_passed_}) list->reserve(results_.impacts.capacity());
    for (std::vector<IdPair>* list : {&began_, &ended_}) list->reserve(capacity + results_.impacts.capacity());
    fractions_.reserve(began_.capacity());
    last_found_.reserve_like(results_.found);
    contacts_.reserve(results_.found.contacts.capacity());
    last_near_.reserve(near_.capacity());
    memory_->reserve(filters_edges_ ? items_.size() : 0, near_.capacity(), results_.found.contacts.capacity());
    compare_with_last();
    pair_index_.build(results_.touching, capacity);

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

template <int D>
void detail::DeleteUpdateState<D>::operator()(UpdateState<D>* state) const {
    delete state;
}

template struct detail::DeleteUpdateState<2>;
template struct detail::DeleteUpdateState<3>;
template class World<2>;
template class World<3>;

}  // namespace abut
