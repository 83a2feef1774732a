#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/temporal_core.hpp>
#include <abut/broad_phase/temporal_reach-inl.h>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/cache_control.h>

namespace abut {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();
constexpr double endless = std::numeric_limits<double>::infinity();

float usable_speed(float speed) {
    ABUT_ASSERT(speed >= 0);
    return speed >= 0 ? speed : unbounded;
}

}  // namespace

template <int D>
void TemporalCore<D>::build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds,
                            TemporalSearch<D>& search) {
    ABUT_ASSERT(boxes.size() == top_speeds.size());
    wanted_.assign(boxes.size(), unbounded);
    const auto given = top_speeds.first(std::min(boxes.size(), top_speeds.size()));
    std::transform(given.begin(), given.end(), wanted_.begin(), usable_speed);
    counts_ = {};
    start(boxes, search);
}

template <int D>
void TemporalCore<D>::update(std::span<const Aabb<D>> boxes, double time, TemporalSearch<D>& search) {
    ABUT_ASSERT(boxes.size() == size());
    if (boxes.size() != size()) {
        wanted_.resize(boxes.size(), unbounded);
        return start(boxes, search);
    }
    ++counts_.updates;
    counts_.plain_searches += size();
    advance(time);
    count_waiting();
    // Items too fast for any group have been searched for as often as all of them are by starting anew.
    if (groups_[0].waited > 0 && groups_[0].waited >= static_cast<double>(size())) return start(boxes, search);
    choose_due();
    drop_left();
    look_at_due(boxes);
    drop_left();
    regroup();
    search_due(boxes, search);
    count_held();
}

template <int D>
void TemporalCore<D>::set_top_speed(std::uint32_t item, float speed) {
    ABUT_ASSERT(item < size());
    wanted_[item] = usable_speed(speed);
    if (wanted_[item] > items_[item].speed) leave(item);
}

template <int D>
void TemporalCore<D>::jumped(std::uint32_t item) {
    ABUT_ASSERT(item < size());
    if (items_[item].group != 0) leave(item);
}

/// For group 0, until the group where it belongs is searched next.
template <int D>
void TemporalCore<D>::leave(std::uint32_t index) {
    Item& item = items_[index];
    groups_[item.group].left = groups_[item.group].changed = groups_[0].changed = true;
    groups_[0].members.push_back(index);
    item.group = 0;
    item.speed = unbounded;
}

/// Where it has gone farther than it may, it leaves its group.
template <int D>
void TemporalCore<D>::check(const Item& item, const BoxLanes<D>& box) {
    if (item.group == 0) return;
    const bool kept_to_its_top_speed = within_way(BoxLanes<D>(item.box), box, item.speed * groups_[item.group].elapsed);
    ABUT_ASSERT(kept_to_its_top_speed);
    if (kept_to_its_top_speed) return;
    ++counts_.too_fast;
    leave(static_cast<std::uint32_t>(&item - items_.data()));
}

/// Rounded up: between two moments, never less time is taken to have gone by than has. Where the sum could no longer
/// tell one update from the next, or was given no number, time begins anew with a search for all.
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

/// What is searched for in group 0, on whose account.
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
void TemporalCore<D>::look_at_due(std::span<const Aabb<D>> boxes) {
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
                return {no_later(elapsed + time_for(reach.way, speed)), reach.touching};
            };
            const std::size_t looks = pairs.pairs.look_at_due(no_earlier(elapsed), fetch, look);
            counts_.looks += looks;
            groups_[a].window.spend(SearchWindow::look_cost * static_cast<double>(looks));
            if (a != b) groups_[b].window.spend(SearchWindow::look_cost * static_cast<double>(looks));
        }
    }
}

/// The pairs of items that have left their groups. Tables that are about to be filled anew don't matter.
template <int D>
void TemporalCore<D>::drop_left() {
    for (std::uint32_t a = 1; a < temporal_groups; ++a) {
        for (std::uint32_t b = a; b < temporal_groups; ++b) {
            if (!(groups_[a].left || groups_[b].left) || groups_[a].due || groups_[b].due) continue;
            table(a, b).pairs.keep_if(
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
    std::size_t blocks = 0;
    for (const Table& pairs : tables_) blocks += pairs.pairs.blocks();
    // Some of the blocks of all tables in a row.
    const auto tell = [&](std::size_t begin, std::size_t end, PairsCall to) {
        PairBuffer out(to);
        std::size_t first = 0;
        for (const Table& pairs : tables_) {
            const std::size_t count = pairs.pairs.blocks();
            const std::size_t from = std::max(begin, first), until = std::min(end, first + count);
            if (from < until && !pairs.pairs.tell(from - first, until - first, out)) return false;
            first += count;
        }
        return out.flush();
    };
    const std::size_t parts =
        executor == nullptr ? 1 : std::min<std::size_t>(4 * std::size_t{executor->workers()}, blocks / 16);
    if (parts <= 1) {
        tell(0, blocks, visit);
        return;
    }
    report_in_parallel(*executor, static_cast<std::uint32_t>(parts), visit, [&](std::uint32_t part, PairsCall told) {
        tell(blocks * part / parts, blocks * (part + 1) / parts, told);
    });
}

template class TemporalCore<2>;
template class TemporalCore<3>;

}  // namespace abut
