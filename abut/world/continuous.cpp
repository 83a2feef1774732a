// What continuous items meet between two updates: the broad phases get boxes around the ways of all that have moved,
// and the pairs that come near are swept.

#include <abut/broad_phase/boxes.hpp>
#include <abut/query/sweep.hpp>
#include <abut/query/sweep_turning.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

namespace abut {

/// Has a box, then as now.
template <int D>
bool World<D>::has_way(std::uint32_t slot) const {
    const std::uint32_t course = items_[slot].course;
    return course != no_way && !ways_.empty() && !is_empty(ways_[course].box);
}

template <int D>
void World<D>::widen_boxes() {
    widened_ = false;
    if (continuous_ == 0) return;
    ways_.assign(courses_.size(), Way<D>());
    for (const std::uint32_t slot : pending_) {
        const Item& item = items_[slot];
        if (item.course == no_way || is_empty(box(slot))) continue;
        const Pose<D>& from = courses_[item.course];
        const Aabb<D> first = box_at(item, from);
        if (is_empty(first)) continue;
        Way<D>& way = ways_[item.course];
        way = turning_way(item.own_ball.ball(), first, Motion<D>::between(from, item.pose));
        boxes_of(item).widen(item.place, merged(bounds(way), box(slot)));
        widened_ = true;
    }
}

template <int D>
Way<D> World<D>::way_of(std::uint32_t slot) const {
    return has_way(slot) ? ways_[items_[slot].course] : straight_way(box(slot), Vec<D>(0.0f));
}

/// Of two items whose boxes in the broad phases overlap: whether those do that they have now, or, of a continuous one,
/// had on the way.
template <int D>
bool World<D>::come_near(std::uint32_t slot, std::uint32_t other) const {
    const Item &a = items_[slot], &b = items_[other];
    if (overlaps(box(slot), box(other))) return true;
    if (!a.continuous && !b.continuous) return false;
    return (has_way(slot) || has_way(other)) && may_meet(way_of(slot), way_of(other));
}

/// Keeps the pair if it has met since the last update, at which it didn't touch.
template <int D>
void World<D>::look_between(const IdPair& pair, bool touch) {
    const std::uint32_t a = pair.a.index - 1, b = pair.b.index - 1;
    if (!has_way(a) && !has_way(b)) return;
    if (std::binary_search(touched_.begin(), touched_.end(), pair)) return;
    const std::optional<Hit<D>> hit = sweep_pair(a, b);
    if (!hit) return;
    met_.push_back({pair.a, pair.b, *hit});
    if (!touch) passed_.push_back(pair);
}

template <int D>
std::optional<Hit<D>> World<D>::sweep_pair(std::uint32_t slot, std::uint32_t other) const {
    const auto from = [this](std::uint32_t each) -> const Pose<D>& {
        return has_way(each) ? courses_[items_[each].course] : items_[each].pose;
    };
    const Item &a = items_[slot], &b = items_[other];
    const Pose<D>&from_a = from(slot), &from_b = from(other), &to_a = a.pose, &to_b = b.pose;
    const View<D> own_a = a.stored.view(), own_b = b.stored.view();
    if (from_a.rotation == to_a.rotation && from_b.rotation == to_b.rotation)
        return abut::sweep(moved(own_a, affine(from_a)), to_a.position - from_a.position, moved(own_b, affine(from_b)),
                           to_b.position - from_b.position);
    return abut::sweep(own_a, from_a, to_a, own_b, from_b, to_b);
}

/// Both lists are sorted.
template <int D>
void World<D>::tell_fractions() {
    fractions_.assign(began_.size(), 1.0f);
    auto met = met_.begin();
    for (std::size_t i = 0; i < began_.size() && met != met_.end(); ++i) {
        while (met != met_.end() && IdPair{met->a, met->b} < began_[i]) ++met;
        if (met != met_.end() && IdPair{met->a, met->b} == began_[i]) fractions_[i] = met->hit.fraction;
    }
}

template class World<2>;
template class World<3>;

}  // namespace abut
