// From moved items to events: boxes, near pairs, contacts, and what is new about them.

#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {

template <int D>
void World<D>::refresh_trees() {
    const bool grown_slots = fixed_boxes_.size() != items_.size();
    fixed_boxes_.resize(items_.size(), Aabb<D>::empty());
    moving_boxes_.resize(items_.size(), Aabb<D>::empty());
    bool fixed_changed = grown_slots;
    for (const std::uint32_t slot : pending_) {
        const Item& item = items_[slot];
        const Aabb<D> as_fixed = item.options.fixed ? item.box : Aabb<D>::empty();
        fixed_changed = fixed_changed || !(as_fixed == fixed_boxes_[slot]);
        fixed_boxes_[slot] = as_fixed;
        moving_boxes_[slot] = item.options.fixed ? Aabb<D>::empty() : item.box;
    }
    if (grown_slots)
        moving_tree_.build(moving_boxes_);
    else
        moving_tree_.update(moving_boxes_);
    if (fixed_changed) fixed_tree_.build(fixed_boxes_);
}

/// Keeps a pair whose boxes overlap, if the layers agree.
template <int D>
void World<D>::consider(std::uint32_t slot, std::uint32_t other) {
    const Item &a = items_[slot], &b = items_[other];
    if ((a.options.layers & b.options.mask) == 0 || (b.options.layers & a.options.mask) == 0) return;
    if (std::holds_alternative<Solid<D>>(a.placed) && std::holds_alternative<Solid<D>>(b.placed)) return;
    near_.push_back({id_of(std::min(slot, other)), id_of(std::max(slot, other))});
}

/// Finds out whether a near pair touches; where neither has moved, it does if it did.
template <int D>
void World<D>::look_at(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    const bool sensor = a.options.sensor || b.options.sensor;
    if (!a.pending && !b.pending) {
        if (!std::binary_search(touched_.begin(), touched_.end(), pair)) return;
        touching_.push_back(pair);
        if (sensor) return;
        const auto last = std::lower_bound(last_contacts_.begin(), last_contacts_.end(), pair,
                                           [](const WorldContact<D>& c, const IdPair& p) {
                                               return IdPair{c.a, c.b} < p;
                                           });
        contacts_.push_back(*last);
        return;
    }
    ++counts_.tested;
    if (sensor) {
        if (overlaps(a.placed, b.placed)) touching_.push_back(pair);
    } else if (const Contact<D> found = contact(a.placed, b.placed)) {
        touching_.push_back(pair);
        contacts_.push_back({pair.a, pair.b, found});
    }
}

template <int D>
void World<D>::compare_with_last() {
    began_.clear();
    stayed_.clear();
    ended_.clear();
    auto now = touching_.begin();
    auto then = touched_.begin();
    while (now != touching_.end() || then != touched_.end()) {
        if (then == touched_.end() || (now != touching_.end() && *now < *then)) {
            began_.push_back(*now++);
        } else if (now == touching_.end() || *then < *now) {
            ended_.push_back(*then++);
        } else {
            stayed_.push_back(*now++);
            ++then;
        }
    }
}

template <int D>
Events World<D>::update() {
    refresh_trees();

    near_.clear();
    const auto keep = [this](std::uint32_t i, std::uint32_t j) { consider(i, j); };
    moving_tree_.each_pair(keep);
    moving_tree_.each_overlapping_pair(fixed_tree_, keep);
    std::sort(near_.begin(), near_.end());

    std::swap(touching_, touched_);
    std::swap(contacts_, last_contacts_);
    touching_.clear();
    contacts_.clear();
    counts_ = {near_.size(), 0};
    for (const IdPair& pair : near_) look_at(pair);
    // Room at once for whatever such a scene may bring: the lists change places, and all pairs may begin, stay or end.
    const std::size_t most = std::max(touching_.capacity(), touched_.capacity());
    for (std::vector<IdPair>* list : {&touched_, &touching_, &began_, &stayed_, &ended_}) list->reserve(most);
    last_contacts_.reserve(contacts_.capacity());
    compare_with_last();

    for (const std::uint32_t slot : pending_) items_[slot].pending = false;
    pending_.clear();
    return {began_, stayed_, ended_};
}

template class World<2>;
template class World<3>;

}  // namespace abut
