#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/temporal/core.hpp>
#include <abut/broad_phase/temporal/reach-inl.h>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/cache_control.h>

namespace abut::detail {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();
constexpr double endless = std::numeric_limits<double>::infinity();

float usable_speed(float speed) {
    ABUT_ASSERT(speed >= 0);
    return speed >= 0 ? speed : unbounded;
}

/// A quarter of the mean edge, or of about the distance to a neighbour, whichever is larger. Ignores huge boxes.
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
    double volume = 1 / count;
    for (int i = 0; i < D; ++i) volume *= static_cast<double>(bounds.max[i]) - static_cast<double>(bounds.min[i]);
    // A power of two approximates the root well enough.
    int exponent = 0;
    std::frexp(volume, &exponent);
    const double spacing = volume > 0 ? std::ldexp(0.5, exponent / D) : 0;
    return 0.25 * std::max(edges / (D * count), spacing);
}

}  // namespace

template <int D>
void TemporalCore<D>::build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds,
                            TemporalSearch<D>& search) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() == top_speeds.size());
    wanted_.assign(boxes.size(), unbounded);
    const auto given = top_speeds.first(std::min(boxes.size(), top_speeds.size()));
    std::transform(given.begin(), given.end(), wanted_.begin(), usable_speed);
    counts_ = {};
    start(boxes, search);
}

template <int D>
void TemporalCore<D>::update(std::span<const Aabb<D>> boxes, double time, TemporalSearch<D>& search) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) {
        wanted_.resize(boxes.size(), unbounded);
        return start(boxes, search);
    }
    ++counts_.updates;
    counts_.plain_searches += size();
    advance(time);
    count_waiting();
    // Starts anew once the items too fast for any group have cost as many searches as a start does.
    if (groups_[0].waited > 0 && groups_[0].waited >= static_cast<double>(size())) return start(boxes, search);
    choose_due();
    remove_left();
    test_due(boxes);
    remove_left();
    regroup();
    search_due(boxes, search);
    count_held();
}

template <int D>
void TemporalCore<D>::set_top_speed(std::uint32_t item, float speed) {
    detail::enter_library();
    ABUT_ASSERT(item < size());
    wanted_[item] = usable_speed(speed);
    if (wanted_[item] > items_[item].speed) leave(item);
}

template <int D>
void TemporalCore<D>::jumped(std::uint32_t item) {
    ABUT_ASSERT(item < size());
    if (items_[item].group != 0) leave(item);
}

/// Moves an item to group 0 until its own group is searched next.
template <int D>
void TemporalCore<D>::leave(std::uint32_t index) {
    Item& item = items_[index];
    groups_[item.group].left = groups_[item.group].changed = groups_[0].changed = true;
    groups_[0].members.push_back(index);
    item.group = 0;
    item.speed = unbounded;
}

/// An item that has moved farther than its top speed allows leaves its group.
template <int D>
void TemporalCore<D>::check(const Item& item, const BoxLanes<D>& box) {
    if (item.group == 0) return;
    const bool within_top_speed = within_travel(BoxLanes<D>(item.box), box, item.speed * groups_[item.group].elapsed);
    ABUT_ASSERT(within_top_speed);
    if (within_top_speed) return;
    ++counts_.too_fast;
    leave(static_cast<std::uint32_t>(&item - items_.data()));
}

/// Rounds up, so that the elapsed time is never too short. Restarts the time with a search for all items if the sum can
/// no longer distinguish two updates, or if the given time is not a number.
template <int D>
void TemporalCore<D>::advance(double time) {
    ABUT_ASSERT(time >= 0);
    for (Group& group : groups_) group.window.count_update();
    if (time == 0) return;
    now_ = std::nextafter(now_ + time, endless);
    const bool countable = time > 0 && now_ < std::numeric_limits<double>::max() && now_ < 0x1p50 * time;
    if (countable)
        step_ = time;
    else
        now_ = 0;
    for (Group& group : groups_) {
        group.elapsed = countable ? no_earlier(now_ - group.start) : unbounded;
        if (!countable) group.end = 0;
    }
}

/// Charges each search in group 0 to the group where the item belongs.
template <int D>
void TemporalCore<D>::count_waiting() {
    const double count = static_cast<double>(groups_[0].members.size());
    const double pairs = static_cast<double>(table(0, 0).pairs.size());
    for (const std::uint32_t item : groups_[0].members) {
        if (wanted_[item] == unbounded) continue;
        Group& group = groups_[group_for(wanted_[item])];
        if (group.window.rests())
            group.window.spend(SearchWindow::item_cost + SearchWindow::pair_cost * pairs / count);
        else
            ++group.waited;
    }
}

template <int D>
void TemporalCore<D>::choose_due() {
    for (std::uint32_t index = 1; index < temporal_groups; ++index) {
        Group& group = groups_[index];
        const double speed = static_cast<double>(group.fastest);
        const bool over = !(now_ < group.end);
        if (group.window.rests()) {
            group.due = group.window.wakes(speed, step_);
        } else if (over) {
            group.window.close(speed, step_);
            group.due = true;
        } else {
            group.due = group.waited > 0 && group.waited >= static_cast<double>(group.members.size());
        }
    }
}

template <int D>
void TemporalCore<D>::test_due(std::span<const Aabb<D>> boxes) {
    for (std::uint32_t a = 1; a < temporal_groups; ++a) {
        for (std::uint32_t b = a; b < temporal_groups; ++b) {
            Table& pairs = table(a, b);
            if (groups_[a].due || groups_[b].due || pairs.pairs.size() == 0) continue;
            const double elapsed = now_ - pairs.start;
            const auto fetch = [items = items_.data(), boxes = boxes.data()](const ItemPair& pair) {
                for (const std::uint32_t item : {pair.first, pair.second}) {
                    hwy::Prefetch(items + item);
                    hwy::Prefetch(boxes + item);
                }
            };
            const auto look = [this, elapsed, items = items_.data(),
                               boxes = boxes.data()](const ItemPair& pair) -> TimedPairs::Look {
                const Item &first = items[pair.first], &second = items[pair.second];
                const float speed = first.speed + second.speed;
                const BoxLanes<D> box(boxes[pair.first]), other(boxes[pair.second]);
                check(first, box);
                check(second, other);
                const Reach reach = reach_of(box, other);
                return {no_later(elapsed + time_for(reach.travel, speed)), reach.touching};
            };
            const std::size_t looks = pairs.pairs.test_due(no_earlier(elapsed), fetch, look);
            counts_.looks += looks;
            groups_[a].window.spend(SearchWindow::look_cost * static_cast<double>(looks));
            if (a != b) groups_[b].window.spend(SearchWindow::look_cost * static_cast<double>(looks));
        }
    }
}

/// Removes the pairs of items that have left their groups, except from tables that are about to be refilled.
template <int D>
void TemporalCore<D>::remove_left() {
    for (std::uint32_t a = 1; a < temporal_groups; ++a) {
        for (std::uint32_t b = a; b < temporal_groups; ++b) {
            if (!(groups_[a].left || groups_[b].left) || groups_[a].due || groups_[b].due) continue;
            table(a, b).pairs.retain_if(
                [&](const ItemPair& pair) { return items_[pair.first].group != 0 && items_[pair.second].group != 0; });
        }
    }
    for (Group& group : groups_) group.left = false;
}

template <int D>
void TemporalCore<D>::count_held() {
    for (std::uint32_t a = 0; a < temporal_groups; ++a) {
        for (std::uint32_t b = a; b < temporal_groups; ++b) {
            const std::size_t held = table(a, b).pairs.size();
            counts_.plain_looks += held;
            groups_[a].window.spend(SearchWindow::held_cost * static_cast<double>(held));
            if (a != b) groups_[b].window.spend(SearchWindow::held_cost * static_cast<double>(held));
        }
    }
}

template <int D>
void TemporalCore<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    detail::enter_library();
    std::size_t blocks = 0;
    for (const Table& pairs : tables_) blocks += pairs.pairs.blocks();
    // Counts the blocks of all tables consecutively.
    const auto report = [&](std::size_t begin, std::size_t end, PairsCall to) {
        PairBuffer out(to);
        std::size_t first = 0;
        for (const Table& pairs : tables_) {
            const std::size_t count = pairs.pairs.blocks();
            const std::size_t from = std::max(begin, first), until = std::min(end, first + count);
            if (from < until && !pairs.pairs.add_touching(from - first, until - first, out)) return false;
            first += count;
        }
        return out.flush();
    };
    const std::size_t parts =
        executor == nullptr ? 1 : std::min<std::size_t>(4 * std::size_t{executor->workers()}, blocks / 16);
    if (parts <= 1) {
        report(0, blocks, visit);
        return;
    }
    report_in_parallel(*executor, static_cast<std::uint32_t>(parts), visit, [&](std::uint32_t part, PairsCall to) {
        report(blocks * part / parts, blocks * (part + 1) / parts, to);
    });
}

/// Starts anew with the present top speeds.
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

/// The top speeds of a group are a quarter of those of the group before.
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

/// Moves each item to the group where it belongs, if that group is searched now.
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

/// Grows the boxes of a group by how far each may move until the next search.
template <int D>
void TemporalCore<D>::grow(Group& group, std::span<const Aabb<D>> boxes) {
    group.fastest = 0;
    for (const std::uint32_t member : group.members) {
        Item& item = items_[member];
        const Aabb<D> box = usable(boxes[member]);
        const bool within_top_speed = item.speed == unbounded || within_travel(BoxLanes<D>(item.box), BoxLanes<D>(box),
                                                                               item.speed * group.elapsed);
        ABUT_ASSERT(within_top_speed);
        if (!within_top_speed) ++counts_.too_fast;
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
        const double travel = item.speed > 0 ? static_cast<double>(item.speed) * length : 0;
        grown_.push_back(travel > 0 ? grown_by_travel(item.box, static_cast<float>(travel)) : item.box);
    }
}

/// Fills a table with the pairs of two groups.
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
        // The boxes of a group that is not searched now still contain items that have left.
        if ((!group.due && items_[first].group != a) || (!other.due && items_[second].group != b)) return;
        ++found;
        // Boxes of group 0 are not grown, so they overlap exactly.
        const bool known = b == 0;
        const Reach reach = known ? Reach{true, 0} : reach_of(BoxLanes<D>(boxes[first]), BoxLanes<D>(boxes[second]));
        float due = TimedPairs::never;
        if (a > 0) {
            const double time = time_for(reach.travel, items_[first].speed + items_[second].speed);
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

template class TemporalCore<2>;
template class TemporalCore<3>;

}  // namespace abut::detail
