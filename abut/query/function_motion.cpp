#include <abut/convex/tolerance.hpp>
#include <abut/query/first_touch.hpp>
#include <abut/query/function_motion.hpp>
#include <abut/query/function_there.hpp>
#include <abut/shape/view/view.hpp>

#include <optional>

namespace abut {
namespace {

/// What goes in more slowly than this part of its way slides.
constexpr double slide_slope = 1e-4;

/// What is far off needn't be known better than to this part of the gap.
constexpr double far_off = 0.1;

/// What slides is looked at whenever it has come this part of its size.
constexpr double slide_stride = 0.25;

/// Steps of a ray that has used up half of them are at most this part of its way so far: a way may have no end.
constexpr double widening = 0.05;

/// Of a search for a place that touches, where nothing hangs on its being the deepest.
constexpr int few_boxes = 8;

/// The bound on looks for the moment at which two touch, once it is known between which two it is.
constexpr int most_halvings = 40;

/// Of a function's own frame.
template <int D>
struct OwnLine {
    DVec<D> origin, direction;

    DVec<D> at(double along) const { return origin + direction * along; }
};

template <int D>
double own_distance(const DistanceFunction<D>& function, const DVec<D>& point) {
    const auto here = static_cast<double>(function.distance(function.object, to_float(point)));
    return here == here ? here : std::numeric_limits<double>::infinity();
}

/// Steps as long as the distance, of a function that knows no cells. `least` is the least step.
template <int D>
DistanceCrossing crossing_by_steps(const DistanceFunction<D>& function, const OwnLine<D>& line, double reach,
                                   const DistanceRange& range, double least) {
    const double speed = length(line.direction) * static_cast<double>(function.slope);
    double along = 0, here = own_distance(function, line.origin);
    for (int step = 0; step < function_ray_most_steps; ++step) {
        const double room = std::min(here - range.low, range.high - here);
        double next = along + std::max(room / speed, least);
        const int left = function_ray_most_steps - step;
        if (2 * left < function_ray_most_steps)
            next = std::max(next, along + std::min((reach - along) / left, widening * along));
        next = std::min(next, reach);
        double there = own_distance(function, line.at(next));
        if (there > range.low && there < range.high) {
            if (next >= reach) return {};
            along = next;
            here = there;
            continue;
        }
        const bool below = there <= range.low;
        for (int i = 0; i < most_halvings; ++i) {
            const double middle = along + 0.5 * (next - along);
            if (!(middle > along && middle < next)) break;
            const double between = own_distance(function, line.at(middle));
            const bool is_out = below ? between <= range.low : between >= range.high;
            (is_out ? next : along) = middle;
        }
        return {next, true, below};
    }
    return {};
}

/// The part of a line in a box.
template <int D>
bool clip_to(const Aabb<D>& box, const OwnLine<D>& line, double& from, double& until) {
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

/// How a point on a straight way gains contact with a function's shape.
template <int D>
class PointOnWay {
public:
    struct Gain {
        double along = 0;
        DVec<D> out;  ///< of length 1, in the world
        bool started_inside = false;
    };

    PointOnWay(const DistanceFunction<D>& function, const DRay<D>& beam)
        : function_(function), seen_(function), beam_(beam) {
        line_ = {seen_.back().point(beam.origin), seen_.back().vector(beam.direction)};
    }

    /// `doubt`: what is as near may touch, in lengths of the world.
    bool run(double doubt, Gain& gain) {
        const Aabb<D>& own = function_.bounds;
        if (!(own.min[0] <= own.max[0])) return false;
        const double rounding = sixteen_ulp * largest(line_.origin) * seen_.factor();
        doubt = std::max(doubt, rounding);
        const double level = seen_.level(), own_doubt = doubt / seen_.factor();
        const Aabb<D> box = grown(own, static_cast<float>(level + 2 * own_doubt));
        double from = 0, until = beam_.length;
        if (!clip_to(box, line_, from, until)) return false;
        // What of a function without bounds is farther than this is beyond all floats.
        until = std::min(until, from + 1e30);
        const double size =
            is_finite(own.min) && is_finite(own.max)
                ? 0.5 * length(DVec<D>(own.max) - DVec<D>(own.min)) * seen_.factor()
                : std::max(std::abs(seen_.at(beam_.at(from))), largest(line_.at(from)) * seen_.factor());
        least_ = std::max(1e-4 * std::min(size, until - from), 0.25 * own_doubt);
        if (function_.resolution > 0) least_ = std::min(least_, 0.25 * static_cast<double>(function_.resolution));
        step_ = seen_.step(beam_.at(from), 1e-2 * std::min(size, until - from));

        double along = from;
        double here = own_distance(function_, line_.at(along)) - level;
        if (beam_.rests() && !(here <= own_doubt)) return false;
        if (here <= own_doubt) {
            // It starts there, or the box is no larger than the shape.
            const DVec<D> out = seen_.normal(beam_.at(along), step_);
            const double closing = -dot(out, beam_.direction);
            if (closing > slide_slope || (from > 0 && here <= 0) || beam_.rests()) {
                gain = {along, facing(out), from == 0 && here < -own_doubt};
                return true;
            }
            const DistanceRange range{std::min(here, 0.0) - 2 * own_doubt + level, level + 2 * own_doubt};
            const DistanceCrossing leaves = crossing(along, until, range);
            if (!leaves.found) return false;
            along += leaves.along;
            if (leaves.below) return tell(along, gain);
        }
        const DistanceCrossing enters = crossing(along, until, {level, std::numeric_limits<double>::infinity()});
        return enters.found && tell(along + enters.along, gain);
    }

private:
    DistanceCrossing crossing(double from, double until, const DistanceRange& range) const {
        const OwnLine<D> rest{line_.at(from), line_.direction};
        if (function_.crossing != nullptr)
            return function_.crossing(function_.object, rest.origin, rest.direction, until - from, range);
        return crossing_by_steps(function_, rest, until - from, range, least_);
    }
    bool tell(double along, Gain& gain) const {
        gain = {along, facing(seen_.normal(beam_.at(along), step_)), false};
        return along <= beam_.length;
    }
    /// A normal that doesn't face the origin is of an edge, where there are several.
    DVec<D> facing(const DVec<D>& out) const {
        const double along = dot(out, beam_.direction);
        if (along < 0) return out;
        return normalized(out - beam_.direction * (along + 1e-6), -beam_.direction);
    }

    const DistanceFunction<D>& function_;
    FunctionThere<D> seen_;
    const DRay<D>& beam_;
    OwnLine<D> line_;
    double least_ = 0, step_ = 0;
};

/// Two parts on their ways, by what tells their distance at a time.
template <int D>
struct Course {
    double end = 1;       ///< times go from 0 to there
    double speed = 0;     ///< by which the distance changes at most
    double margin = 0;    ///< of doubt
    double slide = 1;     ///< how long what slides needn't be looked at
    double from = 0;      ///< until then nothing touches, as their boxes tell
    bool proves = false;  ///< stretches of it can be proven free
};

/// The first contact gained. distance_at(time, wanted) tells a SignedDistance; closing(distance, time) how fast it
/// falls; is_free(from, until, time) proves that they don't touch between, or tells a time at which they may.
template <int D, class DistanceAt, class Closing, class IsFree>
std::optional<Gained<D>> first_gain(const Course<D>& course, const DistanceAt& distance_at, const Closing& closing,
                                    const IsFree& is_free) {
    const double margin = course.margin;
    DistanceWanted at_first;
    if (course.proves) at_first.reach = margin;
    Gained<D> now{course.from, distance_at(course.from, at_first), false};
    bool touches = now.distance.distance <= margin;
    double floor = -std::numeric_limits<double>::infinity();
    if (touches) {
        const double start = now.distance.distance, falls = closing(now.distance, now.time);
        now.started_inside = start < -margin;
        floor = std::min(start, 0.0) - margin;
        if (falls > slide_slope * course.speed) {
            const double ahead = std::min(course.end, now.time + 4 * margin / falls);
            const double expected = falls * (ahead - now.time);
            if (distance_at(ahead, {}).distance <= start - 0.25 * expected) return now;
        }
        now.started_inside = false;
    }
    /// Between a time at which they don't touch (or not so deep) and one at which they do.
    const auto refine = [&](Gained<D> before, Gained<D> after, double wanted) {
        for (int i = 0; i < most_halvings; ++i) {
            if (after.distance.distance >= wanted - margin) break;
            const double above = before.distance.distance - wanted, below = wanted - after.distance.distance;
            const double share = i % 2 == 0 && above > 0 ? std::clamp(above / (above + below), 0.05, 0.95) : 0.5;
            const double time = before.time + (after.time - before.time) * share;
            if (!(time > before.time && time < after.time)) break;
            const Gained<D> between{time, distance_at(time, {}), false};
            (between.distance.distance <= wanted ? after : before) = between;
        }
        // Where it jumps there is nothing between: the last time at which they don't touch.
        return after.distance.distance >= wanted - 2 * margin ? after : before;
    };
    double rough = 0;  // by which it may be less
    for (int step = 0; step < function_sweep_most_steps; ++step) {
        if (course.proves && !touches) {
            const auto near_by = [&](double time) { return distance_at(time, {.most_boxes = few_boxes}); };
            return first_touch(now, course.end, course.speed, margin, near_by, closing, is_free);
        }
        const double gap = now.distance.distance - rough;
        double stride = touches ? std::max((gap - floor) / course.speed, course.slide)
                                : std::max(gap, 0.25 * margin) / course.speed;
        const int left = function_sweep_most_steps - step;
        if (2 * left < function_sweep_most_steps) stride = std::max(stride, (course.end - now.time) / left);
        if (!(gap < std::numeric_limits<double>::infinity()) || now.time >= course.end) return std::nullopt;
        const double time = std::min(now.time + stride, course.end);
        // Far off it needn't be known exactly.
        rough = touches ? 0 : far_off * std::max(gap, 0.0);
        Gained<D> next{time, distance_at(time, {.rough = rough}), false};
        if (rough > 0 && next.distance.distance <= 4 * rough + margin) {
            rough = 0;
            next.distance = distance_at(time, {});
        }
        if (touches) {
            if (next.distance.distance <= floor) return refine(now, next, floor + 0.5 * margin);
            touches = next.distance.distance <= margin;
        } else if (next.distance.distance <= 0.5 * margin) {
            if (next.distance.distance >= -margin) return next;
            return refine(now, next, 0);
        }
        now = next;
    }
    return std::nullopt;
}

template <int D>
DVec<D> middle_of(const Convex<D>& part) {
    const Aabb<D> box = bounds(part);
    return (DVec<D>(box.min) + DVec<D>(box.max)) * 0.5;
}

template <class A, class B>
bool has_convex_bounded(const A& a, const B& b) {
    constexpr int D = PartDimension<A>::value;
    if constexpr (std::is_same_v<A, Convex<D>>)
        return b.bound != nullptr;
    else if constexpr (std::is_same_v<B, Convex<D>>)
        return a.bound != nullptr;
    else
        return false;
}

/// Whether what moves stays apart from a function on a stretch of its way; else `time` is when it is abreast of the
/// place that was found to touch.
template <int D>
bool is_free_between(const Convex<D>& first, const Convex<D>& last, double wide, const DistanceFunction<D>& function,
                     double from, double until, double& time) {
    DVec<D> place(0.0);
    if (stays_apart(first, last, wide, function, place)) return true;
    const DVec<D> start = middle_of(first), way = middle_of(last) - start;
    const double square = length_squared(way);
    const double share = square > 0 ? std::clamp(dot(place - start, way) / square, 0.0, 1.0) : 0.5;
    time = from + (until - from) * share;
    return false;
}

template <int D>
bool is_ball(const Convex<D>& part) {
    return part.core == Core::points && part.count == 1 && part.inner_radius == 0;
}
template <class Part>
bool is_ball(const Part&) {
    return false;
}

template <int D>
Convex<D> put(const Convex<D>& part, const DVec<D>& by) {
    Convex<D> result = part;
    result.place.offset += by;
    return result;
}
template <int D>
DistanceFunction<D> put(const DistanceFunction<D>& part, const DVec<D>& by) {
    DistanceFunction<D> result = part;
    result.place.offset += by;
    return result;
}
template <int D>
HalfSpaceView<D> put(const HalfSpaceView<D>& part, const DVec<D>& by) {
    return {part.normal, part.offset + dot(part.normal, by)};
}

template <class Part>
double slope_of(const Part& part) {
    if constexpr (is_function<Part>)
        return static_cast<double>(part.slope);
    else
        return 1;
}

/// How far it reaches from its pivot; infinite where it has no bounds.
template <class Part>
double reach_of(const Part& part) {
    constexpr int D = PartDimension<Part>::value;
    const Aabb<D> box = bounds(part);
    if (!(is_finite(box.min) && is_finite(box.max))) return std::numeric_limits<double>::infinity();
    double squares = 0;
    for (int i = 0; i < D; ++i) {
        const double most =
            std::max(std::abs(static_cast<double>(box.min[i])), std::abs(static_cast<double>(box.max[i])));
        squares += most * most;
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

/// When the boxes of two first overlap, one of them moving; false: never.
template <int D>
bool boxes_meet(const Aabb<D>& a, const Aabb<D>& b, const DVec<D>& direction, double& from, double& until) {
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

/// A ball is its centre at what is rounded by its radius.
template <int D>
bool ball_touches(const Convex<D>& ball, const DistanceFunction<D>& function, const Path<D>& path, bool ball_moves,
                  std::uint32_t index, PartTouch<D>& touch) {
    const DVec<D> center = ball.place.point(DVec<D>(ball.vertices()[0]));
    const DVec<D> direction = ball_moves ? path.direction : -path.direction;
    const DRay<D> beam{center, direction, path.length};
    const DistanceFunction<D> wide = rounded(function, ball.radius);
    typename PointOnWay<D>::Gain gain;
    if (!PointOnWay<D>(wide, beam).run(0.5 * function_margin(ball, function), gain)) return false;
    touch.along = gain.along;
    touch.normal = ball_moves ? -gain.out : gain.out;
    touch.started_inside = gain.started_inside;
    touch.feature = {index, 0, ball_moves ? FeatureKind::none : FeatureKind::vertex};
    // A being there, B where it began.
    const DVec<D> then = ball_moves ? beam.at(gain.along) : center;
    touch.point = then - gain.out * ball.radius;
    return true;
}

}  // namespace

template <int D>
bool part_hit(const DRay<D>& beam, const DistanceFunction<D>& part, PartHit<D>& hit) {
    typename PointOnWay<D>::Gain gain;
    if (!PointOnWay<D>(part, beam).run(0, gain)) return false;
    hit = {gain.along, gain.out, gain.started_inside, Feature()};
    return true;
}

template <int D, class A, class B>
requires FunctionPair<A, B>
bool part_touch(const A& a, const Path<D>& path, const B& b, std::uint32_t index, const SweepOptions<D>&,
                PartTouch<D>& touch) {
    if constexpr (std::is_same_v<A, Convex<D>>)
        if (is_ball(a)) return ball_touches(a, b, path, true, index, touch);
    if constexpr (std::is_same_v<B, Convex<D>>)
        if (is_ball(b)) return ball_touches(b, a, path, false, index, touch);
    Course<D> course;
    course.margin = function_margin(a, b);
    course.end = path.length;
    const auto wide = static_cast<float>(course.margin);
    if (!boxes_meet(grown(bounds(a), wide), bounds(b), path.direction, course.from, course.end)) return false;
    course.speed = std::max(slope_of(a), slope_of(b));
    course.slide = slide_stride * std::min(size_of(a), size_of(b));
    course.proves = has_convex_bounded(a, b);
    const auto distance_at = [&](double along, const DistanceWanted& wanted) -> SignedDistance<D> {
        return function_distance(put(a, path.direction * along), b, wanted);
    };
    const auto closing = [&](const SignedDistance<D>& distance, double) {
        return dot(path.direction, distance.normal);
    };
    const auto is_free = [&](double from, double until, double& time) -> bool {
        const DVec<D> start = path.direction * from, end = path.direction * until;
        if constexpr (std::is_same_v<A, Convex<D>>)
            return is_free_between(put(a, start), put(a, end), 0, b, from, until, time);
        else if constexpr (std::is_same_v<B, Convex<D>>)
            return is_free_between(put(b, -start), put(b, -end), 0, a, from, until, time);
        else
            return false;
    };
    const std::optional<Gained<D>> gained = first_gain(course, distance_at, closing, is_free);
    if (!gained) return false;
    touch.along = gained->time;
    touch.normal = gained->distance.normal;
    touch.point = gained->distance.on_a;
    touch.started_inside = gained->started_inside;
    const ClosestCorners<D>& corners = gained->distance.corners;
    if constexpr (std::is_same_v<B, Convex<D>>)
        name_feature(b, corners.b, corners.count, -touch.normal, index, touch.feature);
    else
        touch.feature = {index, 0, FeatureKind::none};
    return true;
}

template <int D, class A, class B>
requires FunctionPair<A, B>
bool first_meeting(const A& a, const RigidPath<D>& path_a, const B& b, const RigidPath<D>& path_b,
                   const TurningLimits& limits, const SearchOptions<D>&, Meeting<D>& meeting) {
    const double reach_a = reach_of(a), reach_b = reach_of(b);
    const double speed_a = std::isfinite(reach_a) ? relative_motion_bounds(path_a, path_b, reach_a).speed
                                                  : std::numeric_limits<double>::infinity();
    const double speed_b = std::isfinite(reach_b) ? relative_motion_bounds(path_b, path_a, reach_b).speed
                                                  : std::numeric_limits<double>::infinity();
    const double speed = std::min(speed_a, speed_b);
    if (!std::isfinite(speed) || !(speed > 0)) return false;
    const auto distance_at = [&](double time, const DistanceWanted& wanted) -> SignedDistance<D> {
        return function_distance(moved(a, place_at(path_a, time)), moved(b, place_at(path_b, time)), wanted);
    };
    const auto closing = [&](const SignedDistance<D>& distance, double time) {
        return dot(distance.normal, path_a.velocity(time, distance.on_a) - path_b.velocity(time, distance.on_b()));
    };
    Course<D> course;
    course.end = limits.until;
    course.speed = speed * std::max(slope_of(a), slope_of(b));
    course.margin = function_margin(moved(a, place_at(path_a, 0)), moved(b, place_at(path_b, 0)));
    course.slide = slide_stride * std::min(size_of(a), size_of(b)) / speed;
    course.proves = has_convex_bounded(a, b);
    // In the frame of the function, in which it rests; a point is nowhere farther from the straight way than an 8th of
    // how it bends.
    const auto stays_free = [](const auto& part, const RigidPath<D>& path, double reach, const auto& function,
                               const RigidPath<D>& frame, double from, double until, double& time) {
        const auto seen_at = [&](double then) {
            return moved(moved(part, place_at(path, then)), back_from(place_at(frame, then)));
        };
        const double wide =
            relative_motion_bounds(path, frame, reach).acceleration * (until - from) * (until - from) / 8;
        return is_free_between(seen_at(from), seen_at(until), wide, function, from, until, time);
    };
    const auto is_free = [&](double from, double until, double& time) -> bool {
        if constexpr (std::is_same_v<A, Convex<D>>)
            return stays_free(a, path_a, reach_a, b, path_b, from, until, time);
        else if constexpr (std::is_same_v<B, Convex<D>>)
            return stays_free(b, path_b, reach_b, a, path_a, from, until, time);
        else
            return false;
    };
    const std::optional<Gained<D>> gained = first_gain(course, distance_at, closing, is_free);
    if (!gained || gained->time > limits.reach) return false;
    Feature feature;
    const ClosestCorners<D>& corners = gained->distance.corners;
    if constexpr (std::is_same_v<B, Convex<D>>)
        name_feature(moved(b, place_at(path_b, gained->time)), corners.b, corners.count, -gained->distance.normal, 0,
                     feature);
    meeting = {gained->time, gained->distance.on_b(), gained->distance.normal, gained->started_inside, feature};
    return true;
}

#define ABUT_INSTANTIATE_FOR(D, A, B)                                                                               \
    template bool part_touch(const A&, const Path<D>&, const B&, std::uint32_t, const SweepOptions<D>&,             \
                             PartTouch<D>&);                                                                        \
    template bool first_meeting(const A&, const RigidPath<D>&, const B&, const RigidPath<D>&, const TurningLimits&, \
                                const SearchOptions<D>&, Meeting<D>&);
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

}  // namespace abut
