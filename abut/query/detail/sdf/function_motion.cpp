#include <abut/convex/tolerance.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/detail/sdf/path_search.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/shape/view/view.hpp>

#include <cmath>
#include <optional>

namespace abut::detail {
namespace {

/// At a distance, an error of this fraction of the gap is allowed.
constexpr double far_off = 0.1;

/// When a ray has used up half of its steps, each is at least this fraction of the length so far, as a ray may be
/// infinite.
constexpr double step_growth = 0.05;

/// The limit on halvings of an interval of time that contains the impact.
constexpr int max_halvings = 40;

template <int D>
double local_distance(const DistanceFunction<D>& function, const DVec<D>& point) {
    const auto here = static_cast<double>(function.distance(function.object, to_float(point)));
    return here == here ? here : std::numeric_limits<double>::infinity();
}

/// Sphere tracing, for a function without cells. `min_step` is the least step.
template <int D>
DistanceCrossing crossing_by_sphere_tracing(const DistanceFunction<D>& function, const DRay<D>& line,
                                            const DistanceRange& range, double min_step) {
    const double reach = line.length;
    const double speed = length(line.direction) * static_cast<double>(function.slope);
    double along = 0, here = local_distance(function, line.origin);
    for (int step = 0; step < function_ray_max_iterations; ++step) {
        const double clearance = std::min(here - range.low, range.high - here);
        double next = along + std::max(clearance / speed, min_step);
        const int left = function_ray_max_iterations - step;
        if (2 * left < function_ray_max_iterations)
            next = std::max(next, along + std::min((reach - along) / left, step_growth * along));
        next = std::min(next, reach);
        double next_distance = local_distance(function, line.at(next));
        if (next_distance > range.low && next_distance < range.high) {
            if (next >= reach) return {};
            along = next;
            here = next_distance;
            continue;
        }
        const bool below = next_distance <= range.low;
        for (int i = 0; i < max_halvings; ++i) {
            const double middle = along + 0.5 * (next - along);
            if (!(middle > along && middle < next)) break;
            const double between = local_distance(function, line.at(middle));
            const bool is_out = below ? between <= range.low : between >= range.high;
            (is_out ? next : along) = middle;
        }
        return {next, true, below};
    }
    return {};
}

/// Clips a line to a box.
template <int D>
bool clip_to(const DVec<D>& low, const DVec<D>& high, const DRay<D>& line, double& from, double& until) {
    for (int i = 0; i < D; ++i) {
        const double below = low[i] - line.origin[i], above = high[i] - line.origin[i];
        if (std::isnan(below) || std::isnan(above)) continue;
        if (line.direction[i] == 0) {
            if (below > 0 || above < 0) return false;
            continue;
        }
        const double first = below / line.direction[i], second = above / line.direction[i];
        from = std::max(from, std::min(first, second));
        until = std::min(until, std::max(first, second));
    }
    return from <= until;
}

/// The first contact of a point on a straight path with a function's shape.
template <int D>
class PointSweep {
public:
    struct PointImpact {
        double along = 0;
        DVec<D> out;  ///< unit vector, in the world
        bool started_inside = false;
    };

    PointSweep(const DistanceFunction<D>& function, const DRay<D>& beam)
        : function_(function), placed_(function), beam_(beam) {
        line_ = {placed_.back().point(beam.origin), placed_.back().vector(beam.direction), beam.length};
    }

    /// Points within `tolerance`, a length of the world, count as touching.
    bool run(double tolerance, PointImpact& impact) {
        const Aabb<D>& own = function_.bounds;
        if (!(own.min[0] <= own.max[0])) return false;
        const double rounding = sixteen_ulp * largest(line_.origin) * placed_.factor();
        tolerance = std::max(tolerance, rounding);
        const double level = placed_.level(), local_tolerance = tolerance / placed_.factor();
        const Aabb<D> box = grown(own, static_cast<float>(level + 2 * local_tolerance));
        double from = 0, until = beam_.length;
        if (!clip_to(DVec<D>(box.min), DVec<D>(box.max), line_, from, until)) return false;
        // Farther points of a function without bounds are beyond the range of floats.
        until = std::min(until, from + 1e30);
        const double size =
            is_finite(own.min) && is_finite(own.max)
                ? 0.5 * length(DVec<D>(own.max) - DVec<D>(own.min)) * placed_.factor()
                : std::max(std::abs(placed_.at(beam_.at(from))), largest(line_.at(from)) * placed_.factor());
        min_step_ = std::max(1e-4 * std::min(size, until - from), 0.25 * local_tolerance);
        if (function_.resolution > 0) min_step_ = std::min(min_step_, 0.25 * static_cast<double>(function_.resolution));
        step_ = placed_.step(beam_.at(from), 1e-2 * std::min(size, until - from));

        double along = from;
        double here = local_distance(function_, line_.at(along)) - level;
        if (beam_.rests() && !(here <= local_tolerance)) return false;
        if (here <= local_tolerance) {
            // It touches at the start, or the box is as small as the shape.
            const DVec<D> out = placed_.normal(beam_.at(along), step_);
            const double closing = -dot(out, beam_.direction);
            if (closing > sliding_slope || (from > 0 && here <= 0) || beam_.rests()) {
                impact = {along, facing(out), from == 0 && here < -local_tolerance};
                return true;
            }
            const DistanceRange range{std::min(here, 0.0) - 2 * local_tolerance + level, level + 2 * local_tolerance};
            const DistanceCrossing leaves = crossing(along, until, range);
            if (!leaves.found) return false;
            along += leaves.along;
            if (leaves.below) return report(along, impact);
        }
        const DistanceCrossing enters = crossing(along, until, {level, std::numeric_limits<double>::infinity()});
        return enters.found && report(along + enters.along, impact);
    }

private:
    DistanceCrossing crossing(double from, double until, const DistanceRange& range) const {
        const DRay<D> rest{line_.at(from), line_.direction, until - from};
        if (function_.crossing != nullptr)
            return function_.crossing(function_.object, rest.origin, rest.direction, until - from, range);
        return crossing_by_sphere_tracing(function_, rest, range, min_step_);
    }
    bool report(double along, PointImpact& impact) const {
        impact = {along, facing(placed_.normal(beam_.at(along), step_)), false};
        return along <= beam_.length;
    }
    /// A normal that doesn't face the start is that of an edge, which has several.
    DVec<D> facing(const DVec<D>& out) const {
        const double along = dot(out, beam_.direction);
        if (along < 0) return out;
        return normalized(out - beam_.direction * (along + 1e-6), -beam_.direction);
    }

    const DistanceFunction<D>& function_;
    PlacedFunction<D> placed_;
    const DRay<D>& beam_;
    DRay<D> line_;
    double min_step_ = 0, step_ = 0;
};

/// A part at a time of its path.
template <int D>
View<D> view_at(const Part<D>& part, const RigidPath<D>& path, double time) {
    return part.visit([&](const auto& own) -> View<D> { return moved(own, place_at(path, time)); });
}

/// The first contact gained, by conservative advancement.
template <int D>
std::optional<TimedDistance<D>> time_of_impact_by_steps(const Part<D>& a, const RigidPath<D>& path_a, const Part<D>& b,
                                                        const RigidPath<D>& path_b, const MotionBounds& motion) {
    const auto distance_at = [&](double time, const DistanceRequest& wanted) {
        const View<D> view_a = view_at(a, path_a, time), view_b = view_at(b, path_b, time);
        return function_distance<D>(single_part(view_a), single_part(view_b), wanted);
    };
    const double tolerance = motion.tolerance;
    TimedDistance<D> now{motion.from, distance_at(motion.from, {}), false};
    bool is_touching = now.distance.distance <= tolerance;
    double floor = -std::numeric_limits<double>::infinity();
    if (is_touching) {
        const double start = now.distance.distance;
        const DVec<D> velocity =
            path_a.velocity(now.time, now.distance.on_a) - path_b.velocity(now.time, now.distance.on_b());
        const double closing_speed = dot(now.distance.normal, velocity);
        now.started_inside = start < -tolerance;
        floor = std::min(start, 0.0) - tolerance;
        if (closing_speed > sliding_slope * motion.speed) {
            const double ahead = std::min(motion.end, now.time + 4 * tolerance / closing_speed);
            const double expected = closing_speed * (ahead - now.time);
            const double deeper = start - 0.25 * expected;
            if (distance_at(ahead, {.sufficient = deeper}).distance <= deeper) return now;
        }
        now.started_inside = false;
    }
    /// Finds the time of contact between a time without contact (or less deep) and one with it.
    const auto refine = [&](TimedDistance<D> before, TimedDistance<D> after, double wanted) {
        for (int i = 0; i < max_halvings; ++i) {
            if (after.distance.distance >= wanted - tolerance || after.time - before.time <= motion.min_interval) break;
            const double above = before.distance.distance - wanted, below = wanted - after.distance.distance;
            const double share = i % 2 == 0 && above > 0 ? std::clamp(above / (above + below), 0.05, 0.95) : 0.5;
            const double time = before.time + (after.time - before.time) * share;
            if (!(time > before.time && time < after.time)) break;
            const TimedDistance<D> between{time, distance_at(time, {}), false};
            (between.distance.distance <= wanted ? after : before) = between;
        }
        // If the distance jumps, there is nothing between: the answer is the last time without contact.
        return after.distance.distance >= wanted - 2 * tolerance ? after : before;
    };
    double excess = 0;  // by which the distance may be too large
    for (int step = 0; step < function_sweep_max_iterations; ++step) {
        const double gap = now.distance.distance - excess;
        double stride = is_touching ? std::max((gap - floor) / motion.speed, motion.sliding_interval)
                                    : std::max(gap, 0.25 * tolerance) / motion.speed;
        const int left = function_sweep_max_iterations - step;
        if (2 * left < function_sweep_max_iterations) stride = std::max(stride, (motion.end - now.time) / left);
        // A function that breaks its promise may be infinitely deep.
        if (!std::isfinite(gap) || now.time >= motion.end) return std::nullopt;
        const double time = std::min(now.time + stride, motion.end);
        // At a distance an approximation suffices.
        excess = is_touching ? 0 : far_off * std::max(gap, 0.0);
        TimedDistance<D> next{time, distance_at(time, {.tolerance = excess}), false};
        if (excess > 0 && next.distance.distance <= 4 * excess + tolerance) {
            excess = 0;
            next.distance = distance_at(time, {});
        }
        if (is_touching) {
            if (next.distance.distance <= floor) return refine(now, next, floor + 0.5 * tolerance);
            is_touching = next.distance.distance <= tolerance;
        } else if (next.distance.distance <= 0.5 * tolerance) {
            if (next.distance.distance >= -tolerance) return next;
            return refine(now, next, 0);
        }
        now = next;
    }
    return std::nullopt;
}

/// The first contact gained of a convex set and a function that bounds itself, in either order.
template <int D>
std::optional<TimedDistance<D>> time_of_impact_by_proofs(const Part<D>& a, const RigidPath<D>& path_a, const Part<D>& b,
                                                         const RigidPath<D>& path_b, const MotionBounds& motion) {
    if (a.is_convex()) return time_of_impact_by_proofs(a.convex(), path_a, b.function(), path_b, motion);
    auto found = time_of_impact_by_proofs(b.convex(), path_b, a.function(), path_a, motion);
    if (found) flip(found->distance);
    return found;
}

/// The first contact gained of two parts, one or both of which are functions.
template <int D>
std::optional<TimedDistance<D>> first_contact(const Part<D>& a, const RigidPath<D>& path_a, const Part<D>& b,
                                              const RigidPath<D>& path_b, MotionBounds& motion) {
    double slope = 1, smaller = std::numeric_limits<double>::infinity();
    bool has_convex = false, bounds_itself = true;
    for (const Part<D>* part : {&a, &b}) {
        has_convex = has_convex || part->is_convex();
        smaller = std::min(smaller, size(*part));
        if (!part->is_function()) continue;
        slope = std::max(slope, static_cast<double>(part->function().slope));
        bounds_itself = bounds_itself && part->function().bound != nullptr;
    }
    motion.sliding_interval = slide_stride * smaller / motion.speed;
    motion.speed *= slope;
    if (has_convex && bounds_itself) return time_of_impact_by_proofs(a, path_a, b, path_b, motion);
    // The distance of two fields may jump by the error of its search, which is more than it changes in this time.
    if (bounds_itself && a.is_function() && b.is_function())
        motion.min_interval = 0.5 * motion.tolerance / motion.speed;
    return time_of_impact_by_steps(a, path_a, b, path_b, motion);
}

/// A ball is its centre against the function rounded by its radius.
template <int D>
bool ball_time_of_impact(const Convex<D>& ball, const DistanceFunction<D>& function, const Path<D>& path,
                         bool ball_moves, std::uint32_t index, LinearImpact<D>& impact) {
    const DVec<D> center = ball.place.point(DVec<D>(ball.vertices()[0]));
    const DVec<D> direction = ball_moves ? path.direction : -path.direction;
    const DRay<D> beam{center, direction, path.length};
    const DistanceFunction<D> grown_function = rounded(function, ball.radius);
    typename PointSweep<D>::PointImpact found;
    if (!PointSweep<D>(grown_function, beam).run(0.5 * function_tolerance<D>(ball, function), found)) return false;
    impact.along = found.along;
    impact.normal = ball_moves ? -found.out : found.out;
    impact.started_inside = found.started_inside;
    impact.feature = {index, 0, ball_moves ? FeatureKind::none : FeatureKind::vertex};
    // A at the impact, B at its start.
    const DVec<D> then = ball_moves ? beam.at(found.along) : center;
    impact.point = then - found.out * ball.radius;
    return true;
}

}  // namespace

template <int D>
bool part_hit(const DRay<D>& beam, const DistanceFunction<D>& part, PartHit<D>& hit) {
    typename PointSweep<D>::PointImpact impact;
    if (!PointSweep<D>(part, beam).run(0, impact)) return false;
    hit = {impact.along, impact.out, impact.started_inside, Feature()};
    return true;
}

template <int D>
bool function_time_of_impact(const AnyPart<D>& a, const Path<D>& path, const AnyPart<D>& b, std::uint32_t index,
                             LinearImpact<D>& impact) {
    if (a.is_convex() && is_ball(a.convex()))
        return ball_time_of_impact(a.convex(), b.function(), path, true, index, impact);
    if (b.is_convex() && is_ball(b.convex()))
        return ball_time_of_impact(b.convex(), a.function(), path, false, index, impact);
    MotionBounds motion;
    motion.tolerance = function_tolerance<D>(a, b);
    motion.end = path.length;
    const Aabb<D> box_a = grown(bounds(a), static_cast<float>(motion.tolerance)), box_b = bounds(b);
    const DRay<D> relative{DVec<D>(0.0), path.direction, path.length};
    if (!clip_to(DVec<D>(box_b.min) - DVec<D>(box_a.max), DVec<D>(box_b.max) - DVec<D>(box_a.min), relative,
                 motion.from, motion.end))
        return false;
    motion.speed = 1;
    RigidPath<D> path_a, path_b;
    path_a.move = path.direction;
    const std::optional<TimedDistance<D>> found = first_contact<D>(a, path_a, b, path_b, motion);
    if (!found) return false;
    impact.along = found->time;
    impact.normal = found->distance.normal;
    impact.point = found->distance.on_a;
    impact.started_inside = found->started_inside;
    impact.feature = {index, 0, FeatureKind::none};
    const ClosestCorners<D>& corners = found->distance.corners;
    if (b.is_convex()) name_feature(b.convex(), corners.b, corners.count, -impact.normal, index, impact.feature);
    return true;
}

template <int D>
bool function_time_of_impact(const AnyPart<D>& a, const RigidPath<D>& path_a, const AnyPart<D>& b,
                             const RigidPath<D>& path_b, const RotatingSweepLimits& limits, RotatingImpact<D>& impact) {
    MotionBounds motion;
    motion.speed = std::numeric_limits<double>::infinity();
    for (const bool by_a : {true, false}) {
        const double reach = reach_of(bounds(by_a ? a : b));
        if (!std::isfinite(reach)) continue;
        motion.speed =
            std::min(motion.speed, relative_motion_bounds(by_a ? path_a : path_b, by_a ? path_b : path_a, reach).speed);
    }
    if (!std::isfinite(motion.speed) || !(motion.speed > 0)) return false;
    motion.end = limits.until;
    const View<D> first_a = view_at<D>(a, path_a, 0), first_b = view_at<D>(b, path_b, 0);
    motion.tolerance = function_tolerance<D>(single_part(first_a), single_part(first_b));
    const std::optional<TimedDistance<D>> found = first_contact<D>(a, path_a, b, path_b, motion);
    if (!found || found->time > limits.reach) return false;
    impact = {found->time, found->distance.on_b(), found->distance.normal, found->started_inside, Feature()};
    const ClosestCorners<D>& corners = found->distance.corners;
    if (b.is_convex())
        name_feature(moved(b.convex(), place_at(path_b, found->time)), corners.b, corners.count, -impact.normal, 0,
                     impact.feature);
    return true;
}

#define ABUT_INSTANTIATE(D)                                                                                    \
    template bool part_hit(const DRay<D>&, const DistanceFunction<D>&, PartHit<D>&);                           \
    template bool function_time_of_impact(const AnyPart<D>&, const Path<D>&, const AnyPart<D>&, std::uint32_t, \
                                          LinearImpact<D>&);                                                   \
    template bool function_time_of_impact(const AnyPart<D>&, const RigidPath<D>&, const AnyPart<D>&,           \
                                          const RigidPath<D>&, const RotatingSweepLimits&, RotatingImpact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
