#include <abut/math/assert.hpp>
#include <abut/math/pose.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/order/projection.hpp>
#include <abut/motion/rearrange.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/view/view.hpp>

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace abut::detail {
namespace {

template <int D>
double farthest_corner(const Aabb<D>& box) {
    DVec<D> corner;
    for (int i = 0; i < D; ++i) corner[i] = static_cast<double>(std::max(std::abs(box.min[i]), std::abs(box.max[i])));
    return length(corner);
}

/// Shapes at changing poses. Refers to the shapes.
template <int D>
class Arrangement {
public:
    Arrangement(std::span<const Convex<D>> shapes, std::span<const Pose<D>> poses)
        : shapes_(shapes), poses_(poses.begin(), poses.end()) {
        for (std::uint32_t i = 0; i < size(); ++i) {
            placed_.push_back(placed_at(i, poses_[i]));
            boxes_.push_back(bounds(placed_.back()));
            reach_.push_back(farthest_corner(bounds(shapes_[i])));
        }
    }

    std::uint32_t size() const { return static_cast<std::uint32_t>(poses_.size()); }
    const Pose<D>& pose(std::uint32_t shape) const { return poses_[shape]; }
    const Convex<D>& placed(std::uint32_t shape) const { return placed_[shape]; }
    Convex<D> placed_at(std::uint32_t shape, const Pose<D>& pose) const { return moved(shapes_[shape], affine(pose)); }
    void set_pose(std::uint32_t shape, const Pose<D>& pose) {
        poses_[shape] = pose;
        placed_[shape] = placed_at(shape, pose);
        boxes_[shape] = bounds(placed_[shape]);
    }

    /// The radius of the shape around its local origin, about which it rotates.
    double reach(std::uint32_t shape) const { return reach_[shape]; }

    /// The lowest other shape that blocks the straight translation of this one to a position. Contact at the end
    /// doesn't block.
    std::optional<std::uint32_t> first_blocker(std::uint32_t shape, const Vec<D>& to) const {
        const Vec<D> motion = to_float(DVec<D>(to) - DVec<D>(poses_[shape].position));
        const Aabb<D> end = bounds(placed_at(shape, Pose<D>{to, poses_[shape].rotation}));
        const Aabb<D> swept = merged(boxes_[shape], end);
        for (std::uint32_t other = 0; other < size(); ++other)
            if (other != shape && overlaps(swept, boxes_[other]) && runs_into(placed_[shape], motion, other))
                return other;
        return std::nullopt;
    }

    /// The lowest other shape within the rotation radius of this one.
    std::optional<std::uint32_t> first_within_reach(std::uint32_t shape) const {
        const Ball<D> reachable{poses_[shape].position, static_cast<float>(reach_[shape])};
        for (std::uint32_t other = 0; other < size(); ++other)
            if (other != shape && !(closest(reachable, placed_[other]).distance > 0)) return other;
        return std::nullopt;
    }

    /// True if a shape that is translated from `start` penetrates `other`.
    bool runs_into(const Convex<D>& start, const Vec<D>& motion, std::uint32_t other) const {
        const Convex<D>& obstacle = placed_[other];
        const std::optional<Hit<D>> hit = sweep(start, motion, obstacle);
        if (!hit) return false;
        // The depth that the rest of the motion would add; a shape may also just touch what it passes.
        const double tolerance = tolerance_for(start, obstacle), distance = length(DVec<D>(motion));
        const double remaining = (1 - static_cast<double>(hit->fraction)) * -dot(DVec<D>(motion), DVec<D>(hit->normal));
        return remaining > tolerance && projected_depth(start, obstacle, DVec<D>(motion) / distance) > tolerance;
    }

private:
    std::span<const Convex<D>> shapes_;
    std::vector<Pose<D>> poses_;
    std::vector<Convex<D>> placed_;
    std::vector<Aabb<D>> boxes_;
    std::vector<double> reach_;
};

}  // namespace
}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

/// Plans the moves and updates the arrangement.
template <int D>
class Planner {
public:
    Planner(std::span<const Convex<D>> shapes, std::span<const Pose<D>> from, std::span<const Pose<D>> to)
        : shapes_(shapes), to_(to), arrangement_(shapes, from) {}

    /// Moves every shape that can go straight to its target, which frees space for others.
    void go_straight() {
        std::deque<std::uint32_t> next;
        std::vector<std::vector<std::uint32_t>> blocked_by(arrangement_.size());
        for (std::uint32_t i = 0; i < arrangement_.size(); ++i)
            if (!is_done(i) && arrangement_.pose(i).rotation == to_[i].rotation) next.push_back(i);
        // A blocked shape is retried only after its blocker has reached its target.
        while (!next.empty()) {
            const std::uint32_t shape = next.front();
            next.pop_front();
            const std::optional<std::uint32_t> blocker = arrangement_.first_blocker(shape, to_[shape].position);
            if (blocker) {
                if (!is_done(*blocker)) blocked_by[*blocker].push_back(shape);
                continue;
            }
            add_move(shape, to_[shape]);
            next.insert(next.end(), blocked_by[shape].begin(), blocked_by[shape].end());
            blocked_by[shape].clear();
        }
    }

    /// Moves all others via parking places far away. Returns the blocking shapes if that fails.
    /// Each lifted shape gets its own level above everything, as high as it needs to rotate; the first to leave gets
    /// the highest one. On its level it gets its own column to the side. It rises through levels that are still empty,
    /// moves to the side and later returns on the same path, through the empty space above the arrangement.
    std::vector<std::uint32_t> go_by_parking(const DVec<D>& away) {
        const std::vector<std::uint32_t> lifted = shapes_to_lift(away);
        std::vector<std::uint32_t> cycle;
        const std::vector<std::uint32_t> leaving = order(lifted, false, away, cycle);
        if (!cycle.empty()) return cycle;
        const std::vector<std::uint32_t> returning = order(lifted, true, away, cycle);
        if (!cycle.empty()) return cycle;

        const DVec<D> aside = perpendicular(away);
        double top = -std::numeric_limits<double>::infinity(), side = top, min_clearance = 0;
        for (std::uint32_t i = 0; i < arrangement_.size(); ++i)
            for (const Pose<D>& pose : {arrangement_.pose(i), to_[i]}) {
                const Convex<D> placed = arrangement_.placed_at(i, pose);
                top = std::max(top, dot(support(placed, away), away));
                side = std::max(side, dot(support(placed, aside), aside));
                min_clearance =
                    std::max(min_clearance, 1e-3 * arrangement_.reach(i) + 1e-5 * largest(DVec<D>(pose.position)));
            }
        const auto at_height = [&](const Vec<D>& position, double height) {
            return DVec<D>(position) + away * (height - dot(DVec<D>(position), away));
        };
        std::vector<double> level(arrangement_.size());
        for (auto last = leaving.rbegin(); last != leaving.rend(); ++last) {
            const double clearance = 1.2 * arrangement_.reach(*last) + min_clearance;
            level[*last] = top + clearance;
            top += 2 * clearance;
        }
        for (const std::uint32_t shape : leaving) {
            const double clearance = 1.2 * arrangement_.reach(shape) + min_clearance;
            const DVec<D> above = at_height(arrangement_.pose(shape).position, level[shape]);
            const DVec<D> parked = above + aside * (side + clearance - dot(above, aside));
            side += 2 * clearance;
            if (const auto blocker = go(shape, to_float(above), to_float(parked))) return {shape, *blocker};
            if (arrangement_.pose(shape).rotation == to_[shape].rotation) continue;
            if (const auto blocker = arrangement_.first_within_reach(shape)) return {shape, *blocker};
            add_move(shape, {arrangement_.pose(shape).position, to_[shape].rotation});
        }
        for (auto next = returning.rbegin(); next != returning.rend(); ++next) {
            const DVec<D> above = at_height(to_[*next].position, level[*next]);
            if (const auto blocker = go(*next, to_float(above), to_[*next].position)) return {*next, *blocker};
        }
        return {};
    }

    const std::vector<Move<D>>& moves() const { return moves_; }

private:
    bool is_done(std::uint32_t shape) const { return arrangement_.pose(shape) == to_[shape]; }
    /// The shapes that aren't at their target, and shapes in place that lie above one of these, before or after.
    std::vector<std::uint32_t> shapes_to_lift(const DVec<D>& away) const {
        Aabb<D> all = Aabb<D>::empty();
        for (std::uint32_t i = 0; i < arrangement_.size(); ++i)
            all = merged(all, merged(bounds(arrangement_.placed(i)), bounds(arrangement_.placed_at(i, to_[i]))));
        const Vec<D> far = to_float(away * length(DVec<D>(all.max) - DVec<D>(all.min)));
        const auto is_above = [&](std::uint32_t upper, const Convex<D>& lower) {
            const Aabb<D> box = bounds(lower);
            const Aabb<D> swept = merged(box, grown(Aabb<D>{box.min + far, box.max + far}, 0));
            return overlaps(swept, bounds(arrangement_.placed(upper))) && arrangement_.runs_into(lower, far, upper);
        };
        std::vector<std::uint32_t> lifted;
        std::vector<bool> is_lifted(arrangement_.size(), false);
        const auto lift = [&](std::uint32_t i) {
            is_lifted[i] = true;
            lifted.push_back(i);
        };
        for (std::uint32_t i = 0; i < arrangement_.size(); ++i)
            if (!is_done(i)) lift(i);
        for (std::size_t next = 0; next < lifted.size(); ++next) {
            const std::uint32_t lower = lifted[next];
            const Convex<D> target = arrangement_.placed_at(lower, to_[lower]);
            for (std::uint32_t upper = 0; upper < arrangement_.size(); ++upper)
                if (!is_lifted[upper] && (is_above(upper, arrangement_.placed(lower)) || is_above(upper, target)))
                    lift(upper);
        }
        std::sort(lifted.begin(), lifted.end());
        return lifted;
    }

    std::vector<std::uint32_t> order(const std::vector<std::uint32_t>& lifted, bool at_target, const DVec<D>& away,
                                     std::vector<std::uint32_t>& cycle) const {
        std::vector<Convex<D>> views;
        for (const std::uint32_t i : lifted)
            views.push_back(at_target ? arrangement_.placed_at(i, to_[i]) : arrangement_.placed(i));
        RemovalOrder found = removal_order(std::span<const Convex<D>>(views), to_float(away));
        for (std::uint32_t& i : found.order) i = lifted[i];
        for (std::uint32_t& i : found.cycle) i = lifted[i];
        if (!found) cycle = found.cycle;
        return found.order;
    }

    void add_move(std::uint32_t shape, const Pose<D>& pose) {
        moves_.push_back({shape, arrangement_.pose(shape), pose});
        arrangement_.set_pose(shape, pose);
    }
    /// Moves a shape straight to a place, or via another point if that is blocked. Returns the blocker if both fail.
    std::optional<std::uint32_t> go(std::uint32_t shape, const Vec<D>& via, const Vec<D>& place) {
        const Rotation<D> rotation = arrangement_.pose(shape).rotation;
        if (arrangement_.first_blocker(shape, place)) {
            if (const auto blocker = arrangement_.first_blocker(shape, via)) return blocker;
            add_move(shape, {via, rotation});
            if (const auto blocker = arrangement_.first_blocker(shape, place)) return blocker;
        }
        add_move(shape, {place, rotation});
        return std::nullopt;
    }

    std::span<const Convex<D>> shapes_;
    std::span<const Pose<D>> to_;
    Arrangement<D> arrangement_;
    std::vector<Move<D>> moves_;
};

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
    detail::enter_library();
    bool valid = from.size() == shapes.size() && to.size() == shapes.size() && is_finite(options.away) &&
                 options.away != Vec<D>(0);
    for (std::size_t i = 0; valid && i < shapes.size(); ++i)
        valid = is_finite(moved(shapes[i], affine(from[i]))) && is_finite(moved(shapes[i], affine(to[i])));
    ABUT_ASSERT(valid);
    Rearrangement<D> result;
    if (!valid) {
        result.stuck.resize(shapes.size());
        std::iota(result.stuck.begin(), result.stuck.end(), 0u);
        return result;
    }

    Planner<D> straight(shapes, from, to);
    straight.go_straight();
    for (const DVec<D>& away : directions<D>(options.away)) {
        Planner<D> planner = straight;
        const std::vector<std::uint32_t> stuck = planner.go_by_parking(away);
        if (stuck.empty()) return {planner.moves(), {}};
        if (result.stuck.empty()) result.stuck = stuck;
    }
    return result;
}

template Rearrangement<2> rearrange(std::span<const Convex<2>>, std::span<const Pose<2>>, std::span<const Pose<2>>,
                                    const RearrangeOptions<2>&);
template Rearrangement<3> rearrange(std::span<const Convex<3>>, std::span<const Pose<3>>, std::span<const Pose<3>>,
                                    const RearrangeOptions<3>&);

}  // namespace abut
