#include <abut/math/assert.hpp>
#include <abut/motion/floor_plan.hpp>
#include <abut/motion/rearrange.hpp>

#include <algorithm>
#include <deque>
#include <numeric>

namespace abut {
namespace {

/// Makes the moves, and keeps the plan up to date.
template <int D>
class Mover {
public:
    Mover(std::span<const Convex<D>> shapes, std::span<const Pose<D>> from, std::span<const Pose<D>> to)
        : shapes_(shapes), to_(to), plan_(shapes, from) {}

    /// What can go straight to its place goes there, and makes room for others.
    void go_straight();
    /// All others by way of places far away. The shapes that are in the way, if it can't be done.
    std::vector<std::uint32_t> go_by_far_away(const DVec<D>& away);

    const std::vector<Move<D>>& moves() const { return moves_; }

private:
    bool is_done(std::uint32_t shape) const { return plan_.pose(shape) == to_[shape]; }
    std::vector<std::uint32_t> to_be_lifted(const DVec<D>& away) const;
    std::vector<std::uint32_t> order(const std::vector<std::uint32_t>& lifted, bool at_target, const DVec<D>& away,
                                     std::vector<std::uint32_t>& cycle) const;
    void write(std::uint32_t shape, const Pose<D>& pose) {
        moves_.push_back({shape, plan_.pose(shape), pose});
        plan_.put(shape, pose);
    }
    /// Straight to a place; by way of another one, where that is blocked. The one it runs into both ways, if any.
    std::optional<std::uint32_t> go(std::uint32_t shape, const Vec<D>& by_way_of, const Vec<D>& place);

    std::span<const Convex<D>> shapes_;
    std::span<const Pose<D>> to_;
    FloorPlan<D> plan_;
    std::vector<Move<D>> moves_;
};

template <int D>
void Mover<D>::go_straight() {
    std::deque<std::uint32_t> next;
    std::vector<std::vector<std::uint32_t>> waiting(plan_.size());
    for (std::uint32_t i = 0; i < plan_.size(); ++i)
        if (!is_done(i) && plan_.pose(i).rotation == to_[i].rotation) next.push_back(i);
    // Each comes up again only when another has come to its place for good.
    while (!next.empty()) {
        const std::uint32_t shape = next.front();
        next.pop_front();
        const std::optional<std::uint32_t> blocker = plan_.met(shape, to_[shape].position);
        if (blocker) {
            if (!is_done(*blocker)) waiting[*blocker].push_back(shape);
            continue;
        }
        write(shape, to_[shape]);
        next.insert(next.end(), waiting[shape].begin(), waiting[shape].end());
        waiting[shape].clear();
    }
}

/// Those that aren't where they should be, and what stands right but lies over one of these, here or there.
template <int D>
std::vector<std::uint32_t> Mover<D>::to_be_lifted(const DVec<D>& away) const {
    Aabb<D> all = Aabb<D>::empty();
    for (std::uint32_t i = 0; i < plan_.size(); ++i)
        all = merged(all, merged(bounds(plan_.placed(i)), bounds(plan_.placed_at(i, to_[i]))));
    const Vec<D> far = to_float(away * length(DVec<D>(all.max) - DVec<D>(all.min)));
    const auto over = [&](std::uint32_t upper, const Convex<D>& lower) {
        const Aabb<D> box = bounds(lower);
        const Aabb<D> way = merged(box, grown(Aabb<D>{box.min + far, box.max + far}, 0));
        return overlaps(way, bounds(plan_.placed(upper))) && plan_.meets(lower, far, upper);
    };
    std::vector<std::uint32_t> lifted;
    std::vector<bool> is_lifted(plan_.size(), false);
    const auto lift = [&](std::uint32_t i) {
        is_lifted[i] = true;
        lifted.push_back(i);
    };
    for (std::uint32_t i = 0; i < plan_.size(); ++i)
        if (!is_done(i)) lift(i);
    for (std::size_t next = 0; next < lifted.size(); ++next) {
        const std::uint32_t lower = lifted[next];
        const Convex<D> target = plan_.placed_at(lower, to_[lower]);
        for (std::uint32_t upper = 0; upper < plan_.size(); ++upper)
            if (!is_lifted[upper] && (over(upper, plan_.placed(lower)) || over(upper, target))) lift(upper);
    }
    std::sort(lifted.begin(), lifted.end());
    return lifted;
}

template <int D>
std::vector<std::uint32_t> Mover<D>::order(const std::vector<std::uint32_t>& lifted, bool at_target,
                                           const DVec<D>& away, std::vector<std::uint32_t>& cycle) const {
    std::vector<Convex<D>> views;
    for (const std::uint32_t i : lifted) views.push_back(at_target ? plan_.placed_at(i, to_[i]) : plan_.placed(i));
    RemovalOrder found = removal_order(std::span<const Convex<D>>(views), to_float(away));
    for (std::uint32_t& i : found.order) i = lifted[i];
    for (std::uint32_t& i : found.cycle) i = lifted[i];
    if (!found) cycle = found.cycle;
    return found.order;
}

template <int D>
std::optional<std::uint32_t> Mover<D>::go(std::uint32_t shape, const Vec<D>& by_way_of, const Vec<D>& place) {
    const Rotation<D> rotation = plan_.pose(shape).rotation;
    if (plan_.met(shape, place)) {
        if (const auto blocker = plan_.met(shape, by_way_of)) return blocker;
        write(shape, {by_way_of, rotation});
        if (const auto blocker = plan_.met(shape, place)) return blocker;
    }
    write(shape, {place, rotation});
    return std::nullopt;
}

/// Beyond all there is, each shape has a level of its own, as high as it needs to turn, and the one that leaves first
/// the highest; and to the side of all there is, on that level, a column of its own. So it rises to its level through
/// levels that are still empty, goes to the side where nobody else is, and later comes back the same way, through a
/// space over the arrangement in which nobody stands.
template <int D>
std::vector<std::uint32_t> Mover<D>::go_by_far_away(const DVec<D>& away) {
    const std::vector<std::uint32_t> lifted = to_be_lifted(away);
    std::vector<std::uint32_t> cycle;
    const std::vector<std::uint32_t> leaving = order(lifted, false, away, cycle);
    if (!cycle.empty()) return cycle;
    const std::vector<std::uint32_t> returning = order(lifted, true, away, cycle);
    if (!cycle.empty()) return cycle;

    const DVec<D> aside = perpendicular(away);
    double top = -std::numeric_limits<double>::infinity(), side = top, smallest_room = 0;
    for (std::uint32_t i = 0; i < plan_.size(); ++i)
        for (const Pose<D>& pose : {plan_.pose(i), to_[i]}) {
            const Convex<D> placed = plan_.placed_at(i, pose);
            top = std::max(top, dot(support(placed, away), away));
            side = std::max(side, dot(support(placed, aside), aside));
            smallest_room = std::max(smallest_room, 1e-3 * plan_.reach(i) + 1e-5 * largest(DVec<D>(pose.position)));
        }
    const auto at_height = [&](const Vec<D>& position, double height) {
        return DVec<D>(position) + away * (height - dot(DVec<D>(position), away));
    };
    std::vector<double> level(plan_.size());
    for (auto last = leaving.rbegin(); last != leaving.rend(); ++last) {
        const double room = 1.2 * plan_.reach(*last) + smallest_room;
        level[*last] = top + room;
        top += 2 * room;
    }
    for (const std::uint32_t shape : leaving) {
        const double room = 1.2 * plan_.reach(shape) + smallest_room;
        const DVec<D> above = at_height(plan_.pose(shape).position, level[shape]);
        const DVec<D> parked = above + aside * (side + room - dot(above, aside));
        side += 2 * room;
        if (const auto blocker = go(shape, to_float(above), to_float(parked))) return {shape, *blocker};
        if (plan_.pose(shape).rotation == to_[shape].rotation) continue;
        if (const auto blocker = plan_.near(shape)) return {shape, *blocker};
        write(shape, {plan_.pose(shape).position, to_[shape].rotation});
    }
    for (auto next = returning.rbegin(); next != returning.rend(); ++next) {
        const DVec<D> above = at_height(to_[*next].position, level[*next]);
        if (const auto blocker = go(*next, to_float(above), to_[*next].position)) return {*next, *blocker};
    }
    return {};
}

template <int D>
std::vector<DVec<D>> directions(const Vec<D>& away) {
    std::vector<DVec<D>> result{normalized(DVec<D>(away))};
    for (int i = 0; i < D; ++i)
        for (const double sign : {1.0, -1.0}) result.push_back(axis<D>(i, sign));
    return result;
}

}  // namespace

template <int D>
Rearrangement<D> rearrange(std::span<const Convex<D>> shapes, std::span<const Pose<D>> from,
                           std::span<const Pose<D>> to, const RearrangeOptions<D>& options) {
    bool sound = from.size() == shapes.size() && to.size() == shapes.size() && is_finite(options.away) &&
                 options.away != Vec<D>(0);
    for (std::size_t i = 0; sound && i < shapes.size(); ++i)
        sound = is_finite(moved(shapes[i], affine(from[i]))) && is_finite(moved(shapes[i], affine(to[i])));
    ABUT_ASSERT(sound);
    Rearrangement<D> result;
    if (!sound) {
        result.stuck.resize(shapes.size());
        std::iota(result.stuck.begin(), result.stuck.end(), 0u);
        return result;
    }

    Mover<D> straight(shapes, from, to);
    straight.go_straight();
    for (const DVec<D>& away : directions<D>(options.away)) {
        Mover<D> mover = straight;
        const std::vector<std::uint32_t> stuck = mover.go_by_far_away(away);
        if (stuck.empty()) return {mover.moves(), {}};
        if (result.stuck.empty()) result.stuck = stuck;
    }
    return result;
}

template Rearrangement<2> rearrange(std::span<const Convex<2>>, std::span<const Pose<2>>, std::span<const Pose<2>>,
                                    const RearrangeOptions<2>&);
template Rearrangement<3> rearrange(std::span<const Convex<3>>, std::span<const Pose<3>>, std::span<const Pose<3>>,
                                    const RearrangeOptions<3>&);

}  // namespace abut
