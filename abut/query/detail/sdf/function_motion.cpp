#include <abut/convex/tolerance.hpp>
#include <abut/query/detail/sdf/function_motion.hpp>
#include <abut/query/detail/sdf/path_search.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/shape/view/view.hpp>

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

/// A line in the local frame of a function.
template <int D>
struct LocalLine {
    DVec<D> origin, direction;

    DVec<D> at(double along) const { return origin + direction * along; }
};

template <int D>
double local_distance(const DistanceFunction<D>& function, const DVec<D>& point) {
    const auto here = static_cast<double>(function.distance(function.object, to_float(point)));
    return here == here ? here : std::numeric_limits<double>::infinity();
}

/// Sphere tracing, for a function without cells. `min_step` is the least step.
template <int D>
DistanceCrossing crossing_by_sphere_tracing(const DistanceFunction<D>& function, const LocalLine<D>& line, double reach,
                                            const DistanceRange& range, double min_step) {
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
bool clip_to(const Aabb<D>& box, const LocalLine<D>& line, double& from, double& until) {
    for (int i = 0; i < D; ++i) {
        const double low = static_cast<double>(box.min[i]) - line.origin[i],
                     high = static_cast<double>(box.max[i]) - line.origin[i];
        if (line.direction[i] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        const double first = low / line.direction[i], second = high / line.direction[i];
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
        line_ = {placed_.back().point(beam.origin), placed_.back().vector(beam.direction)};
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
        if (!clip_to(box, line_, from, until)) return false;
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
        const LocalLine<D> rest{line_.at(from), line_.direction};
        if (function_.crossing != nullptr)
            return function_.crossing(function_.object, rest.origin, rest.direction, until - from, range);
        return crossing_by_sphere_tracing(function_, rest, until - from, range, min_step_);
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
    LocalLine<D> line_;
    double min_step_ = 0, step_ = 0;
};

/// The first contact gained, by conservative advancement. distance_at(time, request) returns a SignedDistance;
/// closing(distance, time) returns how fast it falls.
template <int D, class DistanceAt, class Closing>
std::optional<TimedDistance<D>> time_of_impact_by_steps(const MotionBounds& motion, const DistanceAt& distance_at,
                                                        const Closing& closing) {
    const double tolerance = motion.tolerance;
    TimedDistance<D> now{motion.from, distance_at(motion.from, {}), false};
    bool is_touching = now.distance.distance <= tolerance;
    double floor = -std::numeric_limits<double>::infinity();
    if (is_touching) {
        const double start = now.distance.distance, closing_speed = closing(now.distance, now.time);
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
        if (!(gap < std::numeric_limits<double>::infinity()) || now.time >= motion.end) return std::nullopt;
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

/// The first contact gained of a convex set and a function that bounds itself, in either order. `place` moves the set
/// in the frame of the function, which `frame_at` moves in the world.
template <int D, class A, class B, class Place, class Deviation, class FrameAt>
std::optional<TimedDistance<D>> time_of_impact_by_proofs(const A& a, const B& b, const MotionBounds& motion,
                                                         const Place& place, const Deviation& chord_deviation,
                                                         const FrameAt& frame_at) {
    const SetMotion<D> moving{place, chord_deviation};
    std::optional<TimedDistance<D>> found;
    if constexpr (is_function<A>)
        found = time_of_impact_by_proofs(b, a, moving, motion);
    else
        found = time_of_impact_by_proofs(a, b, moving, motion);
    if (!found) return std::nullopt;
    const Affine<D> frame = frame_at(found->time);
    found->distance.normal = frame.vector(found->distance.normal);
    found->distance.on_a = frame.point(found->distance.on_a);
    if (is_function<A>) flip(found->distance);
    return found;
}

template <class A, class B>
constexpr bool has_convex =
    std::is_same_v<A, Convex<PartDimension<A>::value>> || std::is_same_v<B, Convex<PartDimension<B>::value>>;

/// Whether the function of a convex set and a function bounds itself.
template <class A, class B>
bool bounds_itself(const A& a, const B& b) {
    if constexpr (is_function<A>)
        return a.bound != nullptr;
    else
        return b.bound != nullptr;
}

template <class Part>
bool is_ball(const Part&) {
    return false;
}

template <int D>
Convex<D> translated(const Convex<D>& part, const DVec<D>& by) {
    Convex<D> result = part;
    result.place.offset += by;
    return result;
}
template <int D>
DistanceFunction<D> translated(const DistanceFunction<D>& part, const DVec<D>& by) {
    DistanceFunction<D> result = part;
    result.place.offset += by;
    return result;
}
template <int D>
HalfSpaceView<D> translated(const HalfSpaceView<D>& part, const DVec<D>& by) {
    return {part.normal, part.offset + dot(part.normal, by)};
}

template <class Part>
double slope_of(const Part& part) {
    if constexpr (is_function<Part>)
        return static_cast<double>(part.slope);
    else
        return 1;
}

/// The largest distance of the part from its pivot; infinite without bounds.
template <class Part>
double reach_of(const Part& part) {
    constexpr int D = PartDimension<Part>::value;
    const Aabb<D> box = bounds(part);
    if (!(is_finite(box.min) && is_finite(box.max))) return std::numeric_limits<double>::infinity();
    double squares = 0;
    for (int i = 0; i < D; ++i) {
        const double farthest =
            std::max(std::abs(static_cast<double>(box.min[i])), std::abs(static_cast<double>(box.max[i])));
        squares += farthest * farthest;
    }
    return std::sqrt(squares);
}

template <class Part>
double size_of(const Part& part) {
    constexpr int D = PartDimension<Part>::value;
    if constexpr (std::is_same_v<Part, HalfSpaceView<D>>)
        return std::numeric_limits<double>::infinity();
    else
        return size(part);
}

/// The distance of two fields may jump by the error of its search, which is more than it changes in this time.
template <class A, class B>
double min_interval_of(const A& a, const B& b, const MotionBounds& motion) {
    if constexpr (is_function<A> && is_function<B>)
        if (a.bound != nullptr && b.bound != nullptr) return 0.5 * motion.tolerance / motion.speed;
    return 0;
}

/// The interval in which two boxes overlap, one of them moving; false: never.
template <int D>
bool boxes_overlap_during(const Aabb<D>& a, const Aabb<D>& b, const DVec<D>& direction, double& from, double& until) {
    for (int i = 0; i < D; ++i) {
        const double low = static_cast<double>(b.min[i]) - static_cast<double>(a.max[i]),
                     high = static_cast<double>(b.max[i]) - static_cast<double>(a.min[i]);
        if (std::isnan(low) || std::isnan(high)) continue;
        if (direction[i] == 0) {
            if (low > 0 || high < 0) return false;
            continue;
        }
        const double first = low / direction[i], second = high / direction[i];
        from = std::max(from, std::min(first, second));
        until = std::min(until, std::max(first, second));
    }
    return from <= until;
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
    if (!PointSweep<D>(grown_function, beam).run(0.5 * function_tolerance(ball, function), found)) return false;
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

template <int D, class A, class B>
requires FunctionPair<A, B>
bool time_of_impact(const A& a, const Path<D>& path, const B& b, std::uint32_t index, const SweepOptions<D>&,
                    LinearImpact<D>& impact) {
    if constexpr (std::is_same_v<A, Convex<D>>)
        if (is_ball(a)) return ball_time_of_impact(a, b, path, true, index, impact);
    if constexpr (std::is_same_v<B, Convex<D>>)
        if (is_ball(b)) return ball_time_of_impact(b, a, path, false, index, impact);
    MotionBounds motion;
    motion.tolerance = function_tolerance(a, b);
    motion.end = path.length;
    const auto expansion = static_cast<float>(motion.tolerance);
    if (!boxes_overlap_during(grown(bounds(a), expansion), bounds(b), path.direction, motion.from, motion.end))
        return false;
    motion.speed = std::max(slope_of(a), slope_of(b));
    motion.sliding_interval = slide_stride * std::min(size_of(a), size_of(b));
    motion.min_interval = min_interval_of(a, b, motion);
    const auto first_contact = [&]() -> std::optional<TimedDistance<D>> {
        if constexpr (has_convex<A, B>) {
            const auto shifted_by = [&](double along) {
                Affine<D> result;
                result.offset = path.direction * along;
                return result;
            };
            const auto place = [&](double along) { return shifted_by(is_function<A> ? -along : along); };
            const auto frame = [&](double along) { return is_function<A> ? shifted_by(along) : Affine<D>(); };
            const auto straight = [](double, double) { return 0.0; };
            if (bounds_itself(a, b)) return time_of_impact_by_proofs<D>(a, b, motion, place, straight, frame);
        }
        const auto distance_at = [&](double along, const DistanceRequest& wanted) -> SignedDistance<D> {
            return function_distance(translated(a, path.direction * along), b, wanted);
        };
        const auto closing = [&](const SignedDistance<D>& distance, double) {
            return dot(path.direction, distance.normal);
        };
        return time_of_impact_by_steps<D>(motion, distance_at, closing);
    };
    const std::optional<TimedDistance<D>> found = first_contact();
    if (!found) return false;
    impact.along = found->time;
    impact.normal = found->distance.normal;
    impact.point = found->distance.on_a;
    impact.started_inside = found->started_inside;
    const ClosestCorners<D>& corners = found->distance.corners;
    if constexpr (std::is_same_v<B, Convex<D>>)
        name_feature(b, corners.b, corners.count, -impact.normal, index, impact.feature);
    else
        impact.feature = {index, 0, FeatureKind::none};
    return true;
}

template <int D, class A, class B>
requires FunctionPair<A, B>
bool time_of_impact(const A& a, const RigidPath<D>& path_a, const B& b, const RigidPath<D>& path_b,
                    const RotatingSweepLimits& limits, const SearchOptions<D>&, RotatingImpact<D>& impact) {
    const double reach_a = reach_of(a), reach_b = reach_of(b);
    const double speed_a = std::isfinite(reach_a) ? relative_motion_bounds(path_a, path_b, reach_a).speed
                                                  : std::numeric_limits<double>::infinity();
    const double speed_b = std::isfinite(reach_b) ? relative_motion_bounds(path_b, path_a, reach_b).speed
                                                  : std::numeric_limits<double>::infinity();
    const double speed = std::min(speed_a, speed_b);
    if (!std::isfinite(speed) || !(speed > 0)) return false;
    MotionBounds motion;
    motion.end = limits.until;
    motion.speed = speed * std::max(slope_of(a), slope_of(b));
    motion.tolerance = function_tolerance(moved(a, place_at(path_a, 0)), moved(b, place_at(path_b, 0)));
    motion.sliding_interval = slide_stride * std::min(size_of(a), size_of(b)) / speed;
    motion.min_interval = min_interval_of(a, b, motion);
    const auto first_contact = [&]() -> std::optional<TimedDistance<D>> {
        if constexpr (has_convex<A, B>) {
            const RigidPath<D>&frame = is_function<A> ? path_a : path_b, &mover = is_function<A> ? path_b : path_a;
            // A point is nowhere farther from its chord than an eighth of its acceleration times the square of the
            // time.
            const double acceleration =
                relative_motion_bounds(mover, frame, is_function<A> ? reach_b : reach_a).acceleration;
            const auto place = [&](double time) { return back_from(place_at(frame, time)) * place_at(mover, time); };
            const auto frame_at = [&](double time) { return place_at(frame, time); };
            const auto deviation = [&](double first, double last) {
                return acceleration * (last - first) * (last - first) / 8;
            };
            if (bounds_itself(a, b)) return time_of_impact_by_proofs<D>(a, b, motion, place, deviation, frame_at);
        }
        const auto distance_at = [&](double time, const DistanceRequest& wanted) -> SignedDistance<D> {
            return function_distance(moved(a, place_at(path_a, time)), moved(b, place_at(path_b, time)), wanted);
        };
        const auto closing = [&](const SignedDistance<D>& distance, double time) {
            return dot(distance.normal, path_a.velocity(time, distance.on_a) - path_b.velocity(time, distance.on_b()));
        };
        return time_of_impact_by_steps<D>(motion, distance_at, closing);
    };
    const std::optional<TimedDistance<D>> found = first_contact();
    if (!found || found->time > limits.reach) return false;
    Feature feature;
    const ClosestCorners<D>& corners = found->distance.corners;
    if constexpr (std::is_same_v<B, Convex<D>>)
        name_feature(moved(b, place_at(path_b, found->time)), corners.b, corners.count, -found->distance.normal, 0,
                     feature);
    impact = {found->time, found->distance.on_b(), found->distance.normal, found->started_inside, feature};
    return true;
}

#define ABUT_INSTANTIATE_FOR(D, A, B)                                                                       \
    template bool time_of_impact(const A&, const Path<D>&, const B&, std::uint32_t, const SweepOptions<D>&, \
                                 LinearImpact<D>&);                                                         \
    template bool time_of_impact(const A&, const RigidPath<D>&, const B&, const RigidPath<D>&,              \
                                 const RotatingSweepLimits&, const SearchOptions<D>&, RotatingImpact<D>&);
#define ABUT_INSTANTIATE(D)                                                          \
    template bool part_hit(const DRay<D>&, const DistanceFunction<D>&, PartHit<D>&); \
    ABUT_INSTANTIATE_FOR(D, DistanceFunction<D>, Convex<D>)                          \
    ABUT_INSTANTIATE_FOR(D, Convex<D>, DistanceFunction<D>)                          \
    ABUT_INSTANTIATE_FOR(D, DistanceFunction<D>, HalfSpaceView<D>)                   \
    ABUT_INSTANTIATE_FOR(D, HalfSpaceView<D>, DistanceFunction<D>)                   \
    ABUT_INSTANTIATE_FOR(D, DistanceFunction<D>, DistanceFunction<D>)
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
#undef ABUT_INSTANTIATE_FOR

}  // namespace abut::detail
