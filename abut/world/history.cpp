// A slot whose item moves or changes has a track: an entry for each tick that is held. A slot without one was the same
// at all ticks, and its item in past_ is what the next record is compared with.

#include <abut/broad_phase/detail/reserve_one_more.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/motion.hpp>
#include <abut/world/history.hpp>

#include <utility>

namespace abut {

using namespace detail;

/// A few changes and a few long rays alternate in past_: a tree suits them, whatever suits the live world.
template <int D>
History<D>::History(const World<D>& world, std::size_t ticks, const HistoryOptions& options)
    : world_(&world),
      ticks_(std::max<std::size_t>(ticks, 1)),
      options_(options),
      past_(WorldOptions{.broad_phase = BroadPhaseKind::bvh, .filter_edges = world.filters_edges_}) {
    ABUT_ASSERT(ticks > 0);
}

template <int D>
std::uint64_t History<D>::record() {
    detail::clear_upper_halves();
    grow();
    const std::uint64_t tick = recorded_++;
    for (std::uint32_t slot = 0; slot < past_.items_.size(); ++slot) record_slot(slot, tick);

    // Single changes make the trees worse. After so many, a refit costs little beside them.
    constexpr std::size_t refresh_divisor = 8;
    if (changed_boxes_ * refresh_divisor > past_.size()) {
        past_.refresh_now();
        changed_boxes_ = 0;
    }
    return tick;
}

/// Gives past_ the slots that the world has; the lowest of the new ones is the first to be found free.
template <int D>
void History<D>::grow() {
    const std::size_t before = past_.items_.size(), slots = world_->items_.size();
    if (slots <= before) return;
    past_.items_.resize(slots, Item{.stored = AnyShape<D>(Ball<D>{})});
    past_.free_.reserve(slots);
    for (std::size_t slot = slots; slot-- > before;) past_.free_.push_back(static_cast<std::uint32_t>(slot));
    track_of_.resize(slots, none);
}

template <int D>
void History<D>::record_slot(std::uint32_t slot, std::uint64_t tick) {
    const auto in_use = [slot](const std::vector<Item>& items) {
        return slot < items.size() && items[slot].in_use ? &items[slot] : nullptr;
    };
    const Item* const now = in_use(world_->items_);
    if (track_of_[slot] == none) {
        const Item* const last = in_use(past_.items_);
        const bool is_same = now == nullptr || last == nullptr
                                 ? now == last
                                 : now->pose == last->pose && now->is_same_but_for_pose(*last);
        if (is_same) return;
        if (tick == 0 || (!is_recorded(now) && !is_recorded(last))) return show(slot, now);
        begin_track(slot, tick);
    }
    const std::uint32_t index = track_of_[slot];
    Track& track = tracks_[index];
    const Entry last = entry(index, tick + ticks_ - 1);
    Entry next;
    if (now != nullptr) {
        const bool is_same = last.version != none && versions_[last.version].item.is_same_but_for_pose(*now);
        next = {is_same ? last.version : add_version(*now), now->pose};
    }
    if (next.version != last.version || next.pose != last.pose) track.last_change = tick;
    if (is_recorded(now)) track.last_recorded = tick;
    set_entry(entry(index, tick), next);
    if (track.last_change > first_tick() && track.last_recorded >= first_tick()) return;
    end_track(index);
    show(slot, now);
}

/// Begins with the state of the last record at all ticks.
template <int D>
void History<D>::begin_track(std::uint32_t slot, std::uint64_t tick) {
    auto track = static_cast<std::uint32_t>(tracks_.size());
    if (free_tracks_.empty()) {
        detail::reserve_one_more(tracks_);
        tracks_.emplace_back();
        entries_.reserve(tracks_.capacity() * ticks_);
        entries_.resize(tracks_.size() * ticks_);
    } else {
        track = free_tracks_.back();
        free_tracks_.pop_back();
    }
    Entry first;
    if (const Item& item = past_.items_[slot]; item.in_use) first = {add_version(item), item.pose};
    for (std::size_t i = 0; i < ticks_; ++i) set_entry(entry(track, i), first);
    tracks_[track] = {slot, tick, tick};
    track_of_[slot] = track;
}

template <int D>
void History<D>::end_track(std::uint32_t track) {
    for (std::size_t i = 0; i < ticks_; ++i) set_entry(entry(track, i), {});
    track_of_[std::exchange(tracks_[track].slot, none)] = none;
    free_tracks_.reserve(tracks_.capacity());
    free_tracks_.push_back(track);
}

template <int D>
std::uint32_t History<D>::add_version(const Item& item) {
    if (free_versions_.empty()) {
        detail::reserve_one_more(versions_);
        versions_.push_back({item});
        return static_cast<std::uint32_t>(versions_.size() - 1);
    }
    const std::uint32_t version = free_versions_.back();
    free_versions_.pop_back();
    versions_[version].item = item;
    return version;
}

template <int D>
void History<D>::set_entry(Entry& entry, const Entry& value) {
    if (value.version != none) ++versions_[value.version].entries;
    const std::uint32_t before = std::exchange(entry, value).version;
    if (before == none || --versions_[before].entries > 0) return;
    const AnyShape<D> released = std::move(versions_[before].item.stored);
    free_versions_.reserve(versions_.capacity());
    free_versions_.push_back(before);
}

template <int D>
const World<D>& History<D>::at(std::uint64_t tick, float fraction) {
    detail::clear_upper_halves();
    ABUT_ASSERT(contains(tick) && 0 <= fraction && fraction <= 1);
    tick = std::clamp(tick, first_tick(), last_tick());
    const std::uint64_t next_tick = std::min(tick + 1, last_tick());
    for (std::uint32_t i = 0; i < tracks_.size(); ++i) {
        const std::uint32_t slot = tracks_[i].slot;
        if (slot == none) continue;
        const Entry &there = entry(i, tick), &next = entry(i, next_tick);
        const Item& shown = past_.items_[slot];
        if (there.version == none) {
            if (shown.in_use) show(slot, nullptr);
            continue;
        }
        const Item& item = versions_[there.version].item;
        if (!shown.in_use || !shown.is_same_but_for_pose(item)) show(slot, &item);
        Pose<D> pose = there.pose;
        // NaN is not above 0.
        if (fraction > 0 && is_same_item(there, next) && next.pose != there.pose)
            pose = fraction < 1 ? pose_at(Motion<D>::between(there.pose, next.pose), fraction) : next.pose;
        move(slot, pose);
    }
    return past_;
}

template <int D>
bool History<D>::is_same_item(const Entry& a, const Entry& b) const {
    return b.version != none && versions_[a.version].item.generation == versions_[b.version].item.generation;
}

/// Gives a slot of past_ an item, or none.
template <int D>
void History<D>::show(std::uint32_t slot, const Item* shown) {
    Item& item = past_.items_[slot];
    std::vector<std::uint32_t>& free = past_.free_;
    if (item.in_use)
        past_.free_slot(slot);
    else if (shown != nullptr)
        free.erase(std::next(std::find(free.rbegin(), free.rend(), slot)).base());
    ++changed_boxes_;
    if (shown == nullptr) return free.push_back(slot);
    const bool pending = item.pending;
    item = *shown;
    item.pending = pending;
    item.settled = false;
    item.previous = none;
    ++past_.count_;
    past_.continuous_ += item.continuous ? 1 : 0;
    past_.add_to_boxes(slot);
    update_box(slot);
}

template <int D>
void History<D>::move(std::uint32_t slot, const Pose<D>& pose) {
    Item& item = past_.items_[slot];
    const bool has_moved = item.pose != pose;
    item.pose = pose;  // 0 becomes -0 without a motion
    if (has_moved) update_box(slot);
}

/// Not that of the world, which asserts that the item is finite: the live world has done so.
template <int D>
void History<D>::update_box(std::uint32_t slot) {
    const Item& item = past_.items_[slot];
    past_.boxes_of(item).set(item.place, item.bounds());
    past_.mark_pending(slot);
    ++changed_boxes_;
}

template class History<2>;
template class History<3>;

}  // namespace abut
