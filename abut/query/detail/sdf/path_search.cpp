#include <abut/query/detail/sdf/conditional_gradient.hpp>
#include <abut/query/detail/sdf/function_pairs.hpp>
#include <abut/query/detail/sdf/path_search.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {
namespace {

/// The limit on boxes of one proof; a shorter path may take fewer.
constexpr int max_boxes_of_proof = 192;

/// The limits on turns back to the first contact, and on evaluations along the path of one point.
constexpr int max_turns = 40, max_root_steps = 40;

/// Fractions of the tolerance: a proof and a descent are right to the first. The distance at the time of impact is
/// between the next two, and its search aims at the last, so that the proof of the time before it has some clearance.
constexpr double fraction_searched = 0.25, min_touching = -0.25, max_touching = 0.5, aimed_at = 0.125;

/// The precision of an exact distance, as a fraction of the tolerance, and of a descent on the way to the first
/// contact, as a fraction of the last depth.
constexpr double fraction_exact = 0.5, fraction_of_depth = 0.1;

template <int D>
class PathSearch {
public:
    PathSearch(const Convex<D>& set, const RigidPath<D>& path_of_set, const DistanceFunction<D>& function,
               const RigidPath<D>& path_of_function, const MotionBounds& bounds)
        : set_(set),
          path_of_set_(path_of_set),
          path_of_function_(path_of_function),
          bounds_(bounds),
          frame_(own_frame<D>(function)),
          back_(back_from(frame_)),
          own_(moved(function, back_)),
          placed_(own_),
          tolerance_(bounds.tolerance),
          exact_(fraction_searched * tolerance_),
          search_tolerance_(std::max(tolerance_, function_search_tolerance<D>(set, function))) {
        for (const RigidPath<D>* path : {&path_of_set, &path_of_function})
            is_straight_ = is_straight_ && angular_speed(path->angular_velocity) == 0 &&
                           path->start.offset == DVec<D>(0.0) && path->start.column == Affine<D>::identity();
        acceleration_ =
            relative_motion_bounds(path_of_set, path_of_function, reach_of(detail::bounds(set))).acceleration;
    }

    std::optional<TimedDistance<D>> run() const {
        Touch now = exact(bounds_.from, tolerance_);
        if (!(now.distance <= tolerance_)) return first_contact(bounds_.from, bounds_.end, 0);
        if (goes_deeper(now)) return answer(now, now.distance < -tolerance_);
        // It slides, or leaves: a contact is one deeper than at the start, or any after a time without one.
        const double floor = std::min(now.distance, 0.0) - tolerance_;
        for (int step = 0; step < function_sweep_max_iterations; ++step) {
            if (!(now.distance <= tolerance_)) return first_contact(now.time, bounds_.end, 0);
            if (now.time >= bounds_.end) break;
            double stride = std::max((now.distance - floor) / bounds_.speed, bounds_.sliding_interval);
            const int left = function_sweep_max_iterations - step;
            if (2 * left < function_sweep_max_iterations) stride = std::max(stride, (bounds_.end - now.time) / left);
            const Touch next = exact(std::min(now.time + stride, bounds_.end), tolerance_);
            if (next.distance <= floor) return first_contact(now.time, next.time, floor + 0.5 * tolerance_);
            now = next;
        }
        return std::nullopt;
    }

private:
    /// The deepest point at a time, or the deepest one nearby.
    struct Touch {
        double time;
        DVec<D> point;     ///< of the core, in the function's own frame
        double distance;   ///< of the set from the function there
        DVec<D> gradient;  ///< of the function there
    };

    /// The place of the set in the function's own frame, which is rigid.
    Affine<D> place_at(double time) const {
        if (is_straight_) {
            Affine<D> moved_by;
            moved_by.offset = path_of_set_.move * time - path_of_function_.move * time;
            return back_ * moved_by;
        }
        return back_ * (back_from(detail::place_at(path_of_function_, time)) * detail::place_at(path_of_set_, time));
    }
    /// How far a point may be from its chord: an eighth of its acceleration times the square of the time.
    double chord_deviation(double from, double until) const {
        return acceleration_ * (until - from) * (until - from) / 8;
    }
    Convex<D> set_at(double time) const { return moved(set_, place_at(time)); }

    /// The deepest point; infinite if that is farther off than `reach`.
    Touch exact(double time, double reach) const {
        MinimumOptions<D> options;
        options.tolerance = fraction_exact * tolerance_;
        options.reach = reach + set_.radius;
        const Minimum<D> minimum = minimum_in_convex(placed_, set_at(time), options);
        if (minimum.distance < std::numeric_limits<double>::infinity()) return touch_at(time, minimum.point);
        return {time, minimum.point, minimum.distance, DVec<D>(0.0)};
    }

    /// Descends from a point, or from the point of the set in its direction if the set doesn't contain it. The result
    /// may exceed the minimum by about `tolerance`.
    Touch deepest(double time, const DVec<D>& from, bool contains, double tolerance) const {
        const Convex<D> set = set_at(time);
        const PathHull<D> core(set, nullptr);
        PathPoint<D> first = path_point<D>(from, 0);
        if (!contains) {
            DVec<D> gradient;
            placed_.at(from, gradient);
            first = core.lowest(gradient);
        }
        const ConditionalGradient<D> descent(placed_, core, tolerance, -std::numeric_limits<double>::infinity());
        const LocalMinimum<D> found = descent.descend(first);
        return {time, DVec<D>(found.point), found.value - set_.radius, found.support.gradient};
    }

    Touch touch_at(double time, const DVec<D>& point) const {
        Touch result{time, point, 0, DVec<D>(0.0)};
        result.distance = placed_.at(point, result.gradient) - set_.radius;
        return result;
    }

    /// Whether a touching set goes further in at once, at the deepest point.
    bool goes_deeper(const Touch& touch) const {
        const DVec<D> own = back_from(place_at(touch.time)).point(touch.point);
        const double soon = 1e-6 * (bounds_.end - touch.time);
        if (!(soon > 0)) return false;
        const DVec<D> velocity = (place_at(touch.time + soon).point(own) - touch.point) / soon;
        const double closing_speed = -dot(normalized(touch.gradient), velocity);
        if (!(closing_speed > sliding_slope * bounds_.speed)) return false;
        const double ahead = std::min(bounds_.end, touch.time + 4 * tolerance_ / closing_speed);
        const double expected = closing_speed * (ahead - touch.time);
        return deepest(ahead, place_at(ahead).point(own), true, exact_).distance <= touch.distance - 0.25 * expected;
    }

    /// The first time at which the distance is `level`, after a time at which it is more.
    std::optional<TimedDistance<D>> first_contact(double start, double end, double level) const {
        // Ends of intervals that are still to be proven free, the earliest last. `impact` is at the latest of them.
        std::array<double, static_cast<std::size_t>(path_search_max_proofs) + 1> goals;
        std::size_t count = 1;
        goals[0] = end;
        std::optional<Touch> impact;
        double free_until = start;
        DVec<D> place(0.0);
        for (int proof = 0; proof < path_search_max_proofs; ++proof) {
            const double goal = goals[count - 1], interval = goal - free_until;
            const DVec<D>* hint = impact && count == 1 ? &impact->point : nullptr;
            double time = goal;
            if (is_free(free_until, goal, level, hint, time, place)) {
                if (count == 1) return impact ? std::optional(answer(*impact, false)) : std::nullopt;
                --count;
                free_until = goal;
                continue;
            }
            if (interval * bounds_.speed <= tolerance_) break;
            const bool is_exact = chord_deviation(free_until, goal) == 0;
            const double inner = std::clamp(time, free_until + 0.1 * interval, free_until + 0.75 * interval);
            const Touch probe = is_exact ? touch_at(time, place) : deepest(inner, place, false, exact_);
            std::optional<Touch> earlier;
            if (probe.distance <= level + max_touching * tolerance_) earlier = back_to_first(free_until, probe, level);
            if (earlier && (!impact || earlier->time < goal)) {
                impact = earlier;
                if (!(impact->time > free_until)) break;
                count = 1;
                goals[0] = impact->time;
            } else {
                goals[count++] = inner;
            }
        }
        return answer(deepest(free_until, place, false, exact_), false);
    }

    /// Whether the distance is more than `level` over an interval. If not, it may be less at `place`, a point of the
    /// core at `time`. `hint` is a point of the core at the end.
    bool is_free(double from, double until, double level, const DVec<D>* hint, double& time, DVec<D>& place) const {
        const double radius = set_.radius + level + chord_deviation(from, until);
        MinimumOptions<D> options;
        options.tolerance = fraction_searched * tolerance_;
        options.reach = options.sufficient = radius - (1 - fraction_searched) * tolerance_;
        options.sufficient_bound = radius - search_tolerance_;
        options.max_boxes = max_boxes_of_proof;
        options.hint = hint;
        const Minimum<D> minimum = minimum_in_convex(placed_, set_at(from), set_at(until), options);
        if (minimum.lower_bound >= radius - tolerance_) return true;
        if (minimum.lower_bound >= options.sufficient_bound && !(minimum.distance <= options.sufficient)) return true;
        place = minimum.point;
        time = from + (until - from) * std::clamp(minimum.share, 0.0, 1.0);
        return false;
    }

    /// From a time of contact back to the first contact nearby, after a time without contact. The time at which a point
    /// touches is stationary at the point that touches first, so each turn squares the error.
    Touch back_to_first(double before, Touch touch, double level) const {
        for (int turn = 0; turn < max_turns && touch.distance < level + min_touching * tolerance_; ++turn) {
            const DVec<D> own = back_from(place_at(touch.time)).point(touch.point);
            const double time = time_of_touch(own, before, touch, level + aimed_at * tolerance_);
            if (!(time < touch.time)) break;
            // While the contact is deep, the deepest point needn't be exact.
            const double rough = fraction_of_depth * (level - touch.distance);
            touch = deepest(time, place_at(time).point(own), true, std::max(exact_, rough));
            if (rough > exact_ && touch.distance >= level + min_touching * tolerance_)
                touch = deepest(time, touch.point, true, exact_);
        }
        return touch;
    }

    /// When a point of the set reaches a distance, between a time without contact and one with it: Newton's method,
    /// with bisection.
    double time_of_touch(const DVec<D>& own, double before, const Touch& touch, double aim) const {
        const DVec<D> velocity = (touch.point - place_at(before).point(own)) / (touch.time - before);
        double after = touch.time, time = touch.time, above = touch.distance - aim;
        DVec<D> gradient = touch.gradient;
        for (int step = 0; step < max_root_steps; ++step) {
            const double slope = dot(gradient, velocity), middle = 0.5 * (before + after);
            double next = slope < 0 && step % 4 != 3 ? time - above / slope : middle;
            if (!(next > before && next < after)) next = middle;
            if (!(next > before && next < after)) break;
            time = next;
            above = placed_.at(place_at(time).point(own), gradient) - set_.radius - aim;
            if (std::abs(above) <= aimed_at * tolerance_) return time;
            (above < 0 ? after : before) = time;
        }
        return before;
    }

    TimedDistance<D> answer(const Touch& touch, bool started_inside) const {
        SignedDistance<D> distance = distance_at_point(set_at(touch.time), placed_, touch.point, touch.distance);
        const Affine<D> place = detail::place_at(path_of_function_, touch.time);
        distance.normal = place.vector(frame_.vector(distance.normal));
        distance.on_a = place.point(frame_.point(distance.on_a));
        return {touch.time, distance, started_inside};
    }

    const Convex<D>& set_;
    const RigidPath<D>&path_of_set_, &path_of_function_;
    const MotionBounds& bounds_;
    Affine<D> frame_, back_;  ///< the function's own frame, and back from it
    DistanceFunction<D> own_;
    PlacedFunction<D> placed_;
    double tolerance_, exact_, search_tolerance_, acceleration_ = 0;
    bool is_straight_ = true;  ///< neither path rotates, nor starts rotated or off the origin
};

}  // namespace

template <int D>
std::optional<TimedDistance<D>> time_of_impact_by_proofs(const Convex<D>& set, const RigidPath<D>& path_of_set,
                                                         const DistanceFunction<D>& function,
                                                         const RigidPath<D>& path_of_function,
                                                         const MotionBounds& bounds) {
    if (!(function.bounds.min[0] <= function.bounds.max[0])) return std::nullopt;
    return PathSearch<D>(set, path_of_set, function, path_of_function, bounds).run();
}

#define ABUT_INSTANTIATE(D)                                            \
    template std::optional<TimedDistance<D>> time_of_impact_by_proofs( \
        const Convex<D>&, const RigidPath<D>&, const DistanceFunction<D>&, const RigidPath<D>&, const MotionBounds&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
