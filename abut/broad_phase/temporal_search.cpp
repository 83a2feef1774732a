// Who is searched for with whom, and what is found.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/temporal_core.hpp>
#include <abut/broad_phase/temporal_reach-inl.h>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

/// A quarter of an edge, or about that part of the way to a neighbour, of boxes that aren't huge.
template <int D>
double first_margin(std::span<const Aabb<D>> boxes) {
    const Aabb<D> near{Vec<D>(-1e18f), Vec<D>(1e18f)};
    double edges = 0, count = 0;
    Aabb<D> bounds = Aabb<D>::empty();
    for (const Aabb<D>& given : boxes) {
        const Aabb<D> box = usable(given);
        if (is_empty(box) || !contains(near, box)) continue;
        bounds = merged(bounds, box);
        for (int i = 0; i < D; ++i) edges += static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
        ++count;
    }
    if (count == 0) return 0;
    double room = 1 / count;
    for (int i = 0; i < D; ++i) room *= static_cast<double>(bounds.max[i]) - static_cast<double>(bounds.min[i]);
    // A power of two is near enough to the root.
    int exponent = 0;
    std::frexp(room, &exponent);
    const double spacing = room > 0 ? std::ldexp(0.5, exponent / D) : 0;
    return 0.25 * std::max(edges / (D * count), spacing);
}

}  // namespace

/// Anew, with the top speeds as they are.
template <int D>
void TemporalCore<D>::start(std::span<const Aabb<D>> boxes, TemporalSearch<D>& search) {
    float fastest = 0;
    for (const float speed : wanted_)
        if (speed < unbounded) fastest = std::max(fastest, speed);
    std::frexp(fastest, &fastest_);

    now_ = 0;
    items_.assign(boxes.size(), {Aabb<D>::empty(), unbounded, 0});
    grown_.reserve(boxes.size());
    const double margin = first_margin(boxes);
    for (Group& group : groups_) {
        group.members.clear();
        group.window.begin(margin);
        group.start = group.end = group.waited = 0;
        group.due = group.changed = true;
    }
    groups_[0].members.resize(boxes.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) groups_[0].members[i] = i;
    regroup();
    search_due(boxes, search);
}

/// Each group is four times as slow as the one before it.
template <int D>
std::uint32_t TemporalCore<D>::group_for(float speed) const {
    constexpr int slowest = static_cast<int>(temporal_groups) - 1;
    if (speed == unbounded) return 0;
    int exponent = 0;
    std::frexp(speed, &exponent);
    if (speed == 0) return static_cast<std::uint32_t>(slowest);
    if (exponent > fastest_) return 0;
    return static_cast<std::uint32_t>(std::min(1 + (fastest_ - exponent) / 2, slowest));
}

/// The group where an item is searched for next.
template <int D>
std::uint32_t TemporalCore<D>::home_of(std::uint32_t item) const {
    const std::uint32_t group = group_for(wanted_[item]);
    return groups_[group].window.rests() ? 0 : group;
}

/// Everyone to the group where he belongs, as far as it is searched now.
template <int D>
void TemporalCore<D>::regroup() {
    for (std::uint32_t index = 1; index < temporal_groups; ++index) {
        Group& group = groups_[index];
        if (!group.due) continue;
        std::erase_if(group.members, [&](std::uint32_t item) {
            if (items_[item].group == index && home_of(item) != index) leave(item);
            return items_[item].group != index;
        });
    }
    std::erase_if(groups_[0].members, [&](std::uint32_t item) {
        const std::uint32_t index = home_of(item);
        if (index == 0 || !groups_[index].due) return false;
        items_[item].group = index;
        groups_[index].members.push_back(item);
        groups_[index].changed = groups_[0].changed = true;
        return true;
    });
    groups_[0].due = groups_[0].changed || !groups_[0].members.empty();
    for (Group& group : groups_)
        if (group.due && group.changed) std::sort(group.members.begin(), group.members.end());
}

template <int D>
void TemporalCore<D>::search_due(std::span<const Aabb<D>> boxes, TemporalSearch<D>& search) {
    for (std::uint32_t index = 0; index < temporal_groups; ++index) {
        Group& group = groups_[index];
        if (!group.due) continue;
        grown_.clear();
        if (index > 0)
            grow(group, boxes);
        else
            for (const std::uint32_t member : group.members) grown_.push_back(usable(boxes[member]));
        search.set(index, grown_, group.changed);
        group.changed = false;
        counts_.searches += group.members.size();
        group.window.spend(SearchWindow::item_cost * static_cast<double>(group.members.size()));
    }
    for (std::uint32_t a = 0; a < temporal_groups; ++a)
        for (std::uint32_t b = a; b < temporal_groups; ++b)
            if (groups_[a].due || groups_[b].due) fill(a, b, boxes, search);
    for (Group& group : groups_) group.left = group.due = false;
}

/// The boxes of a group by as far as each may go until its next search.
template <int D>
void TemporalCore<D>::grow(Group& group, std::span<const Aabb<D>> boxes) {
    group.fastest = 0;
    for (const std::uint32_t member : group.members) {
        Item& item = items_[member];
        const Aabb<D> box = usable(boxes[member]);
        const bool kept_to_its_top_speed =
            item.speed == unbounded || within_way(BoxLanes<D>(item.box), BoxLanes<D>(box), item.speed * group.elapsed);
        ABUT_ASSERT(kept_to_its_top_speed);
        if (!kept_to_its_top_speed) ++counts_.too_fast;
        item.box = box;
        item.speed = wanted_[member];
        group.fastest = std::max(group.fastest, item.speed);
    }
    const double length = group.window.length(static_cast<double>(group.fastest));
    group.start = now_;
    group.end = std::nextafter(now_ + length * (1 - 1e-6), 0.0);
    group.elapsed = 0;
    group.waited = 0;
    for (const std::uint32_t member : group.members) {
        const Item& item = items_[member];
        const double way = item.speed > 0 ? static_cast<double>(item.speed) * length : 0;
        grown_.push_back(way > 0 ? grown_by_way(item.box, static_cast<float>(way)) : item.box);
    }
}

/// With what the searches of two groups find in one another.
template <int D>
void TemporalCore<D>::fill(std::uint32_t a, std::uint32_t b, std::span<const Aabb<D>> boxes,
                           const TemporalSearch<D>& search) {
    Table& pairs = table(a, b);
    const Group &group = groups_[a], &other = groups_[b];
    pairs.pairs.clear();
    pairs.start = now_;
    if (group.members.empty() || other.members.empty()) return;
    const double until = std::min(group.end, other.end) - now_;
    std::size_t found = 0;
    const auto add = [&](std::uint32_t in_group, std::uint32_t in_other) {
        const std::uint32_t first = group.members[in_group], second = other.members[in_other];
        // The boxes of a group that isn't searched now still have among them those who left.
        if ((!group.due && items_[first].group != a) || (!other.due && items_[second].group != b)) return;
        ++found;
        // Those of group 0 aren't grown.
        const bool known = b == 0;
        const Reach reach = known ? Reach{true, 0} : reach_of(BoxLanes<D>(boxes[first]), BoxLanes<D>(boxes[second]));
        float due = TimedPairs::never;
        if (a > 0) {
            const double time = time_for(reach.way, items_[first].speed + items_[second].speed);
            if (time < until) due = no_later(time);
        }
        if (due < TimedPairs::never || reach.touching)
            pairs.pairs.add({std::min(first, second), std::max(first, second)}, {due, reach.touching});
    };
    if (a == b)
        search.each_pair(a, add);
    else
        search.each_pair(a, b, add);
    counts_.looks += found;
    for (const std::uint32_t index : {a, b})
        if (index == a || a != b) groups_[index].window.spend(SearchWindow::pair_cost * static_cast<double>(found));
}

template void TemporalCore<2>::start(std::span<const Aabb<2>>, TemporalSearch<2>&);
template std::uint32_t TemporalCore<2>::group_for(float) const;
template std::uint32_t TemporalCore<2>::home_of(std::uint32_t) const;
template void TemporalCore<2>::regroup();
template void TemporalCore<2>::search_due(std::span<const Aabb<2>>, TemporalSearch<2>&);
template void TemporalCore<2>::grow(Group&, std::span<const Aabb<2>>);
template void TemporalCore<2>::fill(std::uint32_t, std::uint32_t, std::span<const Aabb<2>>, const TemporalSearch<2>&);
template void TemporalCore<3>::start(std::span<const Aabb<3>>, TemporalSearch<3>&);
template std::uint32_t TemporalCore<3>::group_for(float) const;
template std::uint32_t TemporalCore<3>::home_of(std::uint32_t) const;
template void TemporalCore<3>::regroup();
template void TemporalCore<3>::search_due(std::span<const Aabb<3>>, TemporalSearch<3>&);
template void TemporalCore<3>::grow(Group&, std::span<const Aabb<3>>);
template void TemporalCore<3>::fill(std::uint32_t, std::uint32_t, std::span<const Aabb<3>>, const TemporalSearch<3>&);

}  // namespace abut
