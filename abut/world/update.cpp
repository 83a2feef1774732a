// From moved items to events: boxes, near pairs, contacts, and what is new about them.

#include <abut/query/overlaps.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {

template <int D>
void World<D>::refresh_boxes() {
    // A game that asks in every other update, or in every tenth, asks about as often all the time: the mean of many. So
    // many questions are counted that it may ask all of a few updates' in one.
    constexpr double remembered = 16;
    const auto counted = static_cast<std::uint32_t>(ray_weight * (moving_.size() + 64));
    const double asked = static_cast<double>(asked_.take(counted)) / ray_weight;
    often_asked_ += (asked / static_cast<double>(std::max<std::size_t>(moving_.size(), 1)) - often_asked_) / remembered;
    moving_.refresh(often_asked_);
    // What is fixed changes seldom, and each item that moves asks it once an update.
    if (fixed_.changed()) fixed_.refresh(1);
}

template <int D>
void World<D>::refresh_now() {
    if (moving_.changed()) moving_.refresh(often_asked_);
    if (fixed_.changed()) fixed_.refresh(1);
}

/// Keeps a pair whose boxes overlap, if the layers agree.
template <int D>
void World<D>::consider(std::uint32_t slot, std::uint32_t other) {
    if (widened_ && !come_near(slot, other)) return;
    const Item &a = items_[slot], &b = items_[other];
    if ((a.layers & b.mask) == 0 || (b.layers & a.mask) == 0) return;
    if (a.type == ShapeType::half_space && b.type == ShapeType::half_space) return;
    near_.push_back({id_of(std::min(slot, other)), id_of(std::max(slot, other))});
}

/// Finds out whether a near pair touches; where neither has moved, it does if it did.
template <int D>
void World<D>::look_at(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    if (!a.pending && !b.pending) return repeat_last(pair);
    ++counts_.tested;
    // By its way alone a pair may be near; whether it touches doesn't depend on that.
    const bool touch = (!widened_ || overlaps(box(pair.a.index - 1), box(pair.b.index - 1))) && touch_now(pair);
    if (a.continuous || b.continuous) look_between(pair, touch);
}

/// Keeps the pair if it does.
template <int D>
bool World<D>::touch_now(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    Pretests::Entry& entry = pretests_.of(a.type, b.type, a.sensor || b.sensor);
    if (pretests_.due(entry)) return measure(pair, entry);
    if (!pretests_.asked(entry) || !balls_apart(pair)) return shapes_touch(pair);
    ++counts_.balls;
    return false;
}

/// Of a pair of which neither has moved; its contact may depend on others beside them.
template <int D>
void World<D>::repeat_last(const IdPair& pair) {
    if (!std::binary_search(touched_.begin(), touched_.end(), pair)) return;
    touching_.push_back(pair);
    const Found* last = find_found(last_found_, pair);
    if (last == nullptr) return;
    if (is_disturbed(pair))
        find_contact(pair);
    else
        found_.push_back(*last);
}

template <int D>
bool World<D>::balls_apart(const IdPair& pair) const {
    return apart(ball(items_[pair.a.index - 1]), ball(items_[pair.b.index - 1]));
}

template <int D>
const View<D>& World<D>::first_placed(std::uint32_t slot) {
    if (first_.slot != slot) {
        first_.slot = slot;
        first_.view = placed(items_[slot]);
    }
    return first_.view;
}

/// Keeps the pair if they do.
template <int D>
bool World<D>::shapes_touch(const IdPair& pair) {
    const Item &a = items_[pair.a.index - 1], &b = items_[pair.b.index - 1];
    if (a.sensor || b.sensor) {
        if (!overlaps(first_placed(pair.a.index - 1), placed(b))) return false;
    } else if (!find_contact(pair)) {
        return false;
    }
    touching_.push_back(pair);
    return true;
}

/// Asks the balls and, whatever they say, the shapes, and learns what that costs. The balls many times, as it takes
/// less than looking at a clock, and once before: where they aren't in use, that time goes into fetching them from
/// memory.
template <int D>
bool World<D>::measure(const IdPair& pair, Pretests::Entry& entry) {
    constexpr int times = 16;
    bool meet = !balls_apart(pair);
    std::array<std::uint64_t, 4> clock{};
    clock[0] = steady_nanoseconds();
    clock[1] = steady_nanoseconds();
    for (int i = 0; i < times; ++i) meet = !balls_apart(pair);
    clock[2] = steady_nanoseconds();
    const bool touch = shapes_touch(pair);
    clock[3] = steady_nanoseconds();
    std::array<double, 3> laps{};
    for (std::size_t i = 0; i < 3; ++i) laps[i] = static_cast<double>(clock[i + 1] - clock[i]);
    laps[1] = laps[0] + (laps[1] - laps[0]) / times;
    pretests_.add(entry, laps, meet, touch);
    return touch;
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
    // None of them is there already: what passes another touches it neither now nor at the last update.
    const auto add = [](const std::vector<IdPair>& passed, std::vector<IdPair>& list) {
        if (passed.empty()) return;
        list.insert(list.end(), passed.begin(), passed.end());
        std::sort(list.begin(), list.end());
    };
    add(passed_, began_);
    add(last_passed_, ended_);
    tell_fractions();
}

template <int D>
Events World<D>::find_events() {
    widen_boxes();
    refresh_boxes();

    std::swap(near_, last_near_);
    near_.clear();
    moving_.phase().each_pair([this](std::uint32_t i, std::uint32_t j) { consider(moving_.slot(i), moving_.slot(j)); });
    moving_.phase().each_overlapping_pair(
        fixed_.phase(), [this](std::uint32_t i, std::uint32_t j) { consider(moving_.slot(i), fixed_.slot(j)); });
    std::sort(near_.begin(), near_.end());
    find_partners();

    std::swap(touching_, touched_);
    std::swap(found_, last_found_);
    std::swap(passed_, last_passed_);
    touching_.clear();
    found_.clear();
    contacts_.clear();
    passed_.clear();
    met_.clear();
    first_.slot = no_way;
    views_.clear();
    counts_ = {near_.size(), 0, 0};
    for (const IdPair& pair : near_) look_at(pair);
    tell_contacts();
    pretests_.decide();
    // Room at once for whatever such a scene may bring: the lists change places, and all pairs may begin, stay or end.
    const std::size_t most = std::max(touching_.capacity(), touched_.capacity());
    for (std::vector<IdPair>* list : {&touched_, &touching_, &stayed_}) list->reserve(most);
    for (std::vector<IdPair>* list : {&passed_, &last_passed_}) list->reserve(met_.capacity());
    for (std::vector<IdPair>* list : {&began_, &ended_}) list->reserve(most + met_.capacity());
    fractions_.reserve(began_.capacity());
    last_found_.reserve(found_.capacity());
    contacts_.reserve(found_.capacity());
    last_near_.reserve(near_.capacity());
    compare_with_last();
    touching_index_.build(touching_, most);

    for (const std::uint32_t slot : pending_) {
        items_[slot].pending = false;
        items_[slot].settled = true;
        items_[slot].course = no_way;
    }
    pending_.clear();
    courses_.clear();
    ways_.clear();
    return {began_, stayed_, ended_, fractions_};
}

template class World<2>;
template class World<3>;

}  // namespace abut
