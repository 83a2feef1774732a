#include <abut/query/detail/sdf/conditional_gradient.hpp>
#include <abut/query/detail/sdf/function_pairs.hpp>
#include <abut/query/detail/sdf/path_search.hpp>

namespace abut {
namespace {

/// The limit on boxes of one proof; a shorter path may take fewer.
constexpr int max_boxes_of_proof = 192;

/// The limits on turns back to the first contact, and on evaluations along the path of one point.
constexpr int max_turns = 40, max_root_steps = 40;

/// Fractions of the tolerance: a search is right to the first. The distance at the time of impact is between the next
/// two, and its search aims at the last, so that the proof of the time before it has some clearance.
constexpr double fraction_searched = 0.25, min_touching = -0.25, max_touching = 0.5, aimed_at = 0.125;

template <int D>
class PathSearch {
public:
    PathSearch(const Convex<D>& set, const DistanceFunction<D>& function, const SetMotion<D>& motion, double tolerance)
        : set_(set),
          motion_(motion),
          frame_(own_frame<D>(function)),
          back_(back_from(frame_)),
          own_(moved(function, back_)),
          placed_(own_),
          tolerance_(tolerance),
          search_tolerance_(std::max(tolerance, function_search_tolerance(set, function))) {}

    std::optional<TimedDistance<D>> run(double start, double end) const {
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
            if (is_free(free_until, goal, hint, time, place)) {
                if (count == 1) return impact ? std::optional(answer(*impact)) : std::nullopt;
                --count;
                free_until = goal;
                continue;
            }
            if (interval * motion_.speed <= tolerance_) break;
            const bool is_exact = motion_.chord_deviation(free_until, goal) == 0;
            const double inner = std::clamp(time, free_until + 0.1 * interval, free_until + 0.75 * interval);
            const Touch probe = deepest(is_exact ? time : inner, place, is_exact);
            if (probe.distance <= max_touching * tolerance_) {
                impact = first_touch(free_until, probe);
                if (!(impact->time > free_until)) break;
                count = 1;
                goals[0] = impact->time;
            } else {
                goals[count++] = inner;
            }
        }
        return answer(deepest(free_until, place, false));
    }

private:
    /// The deepest point nearby at a time.
    struct Touch {
        double time;
        DVec<D> point;     ///< of the core, in the function's own frame
        double distance;   ///< of the set from the function there
        DVec<D> gradient;  ///< of the function
    };

    Convex<D> set_at(double time) const { return moved(set_, back_ * motion_.place_at(time)); }

    /// Whether the set stays apart over an interval. If not, it may touch at `place`, a point of the core at `time`.
    /// `hint` is a point of the core at the end.
    bool is_free(double from, double until, const DVec<D>* hint, double& time, DVec<D>& place) const {
        const double radius = set_.radius + motion_.chord_deviation(from, until);
        MinimumOptions<D> options;
        options.tolerance = fraction_searched * tolerance_;
        options.reach = options.sufficient = radius - (1 - fraction_searched) * tolerance_;
        options.sufficient_bound = radius - search_tolerance_;
        options.max_boxes = max_boxes_of_proof;
        options.hint = hint;
        const Minimum<D> minimum = bounded_minimum(placed_, set_at(from), set_at(until), options);
        if (minimum.lower_bound >= std::min(options.sufficient_bound, radius - tolerance_)) return true;
        place = minimum.point;
        time = from + (until - from) * std::clamp(minimum.share, 0.0, 1.0);
        return false;
    }

    /// Descends from a point, or from the point of the set in its direction if the set doesn't contain it.
    Touch deepest(double time, const DVec<D>& from, bool contains) const {
        const Convex<D> set = set_at(time);
        const PathHull<D> core(set, nullptr);
        PathPoint<D> first = path_point<D>(from, 0);
        if (!contains) {
            DVec<D> gradient;
            placed_.at(from, gradient);
            first = core.lowest(gradient);
        }
        const ConditionalGradient<D> descent(placed_, core, fraction_searched * tolerance_,
                                             -std::numeric_limits<double>::infinity());
        const LocalMinimum<D> found = descent.descend(first);
        return {time, DVec<D>(found.point), found.value - set_.radius, found.support.gradient};
    }

    /// From a time of contact back to the first contact nearby, after a time without contact. The time at which a point
    /// touches is stationary at the point that touches first, so each turn squares the error.
    Touch first_touch(double before, Touch touch) const {
        for (int turn = 0; turn < max_turns && touch.distance < min_touching * tolerance_; ++turn) {
            const DVec<D> own = back_from(back_ * motion_.place_at(touch.time)).point(touch.point);
            const double time = time_of_touch(own, before, touch);
            if (!(time < touch.time)) break;
            touch = deepest(time, (back_ * motion_.place_at(time)).point(own), true);
        }
        return touch;
    }

    /// When a point of the set reaches the distance aimed at, between a time without contact and one with it: Newton's
    /// method, with bisection.
    double time_of_touch(const DVec<D>& own, double before, const Touch& touch) const {
        const auto point_at = [&](double time) { return (back_ * motion_.place_at(time)).point(own); };
        const DVec<D> velocity = (touch.point - point_at(before)) / (touch.time - before);
        const double aim = aimed_at * tolerance_;
        double after = touch.time, time = touch.time, above = touch.distance - aim;
        DVec<D> gradient = touch.gradient;
        for (int step = 0; step < max_root_steps; ++step) {
            const double slope = dot(gradient, velocity);
            double next = slope < 0 && step % 4 != 3 ? time - above / slope : 0.5 * (before + after);
            if (!(next > before && next < after)) next = 0.5 * (before + after);
            if (!(next > before && next < after)) break;
            time = next;
            above = placed_.at(point_at(time), gradient) - set_.radius - aim;
            if (std::abs(above) <= aim) return time;
            (above < 0 ? after : before) = time;
        }
        return before;
    }

    TimedDistance<D> answer(const Touch& touch) const {
        SignedDistance<D> distance = distance_at_point(set_at(touch.time), placed_, touch.point, touch.distance);
        distance.normal = frame_.vector(distance.normal);
        distance.on_a = frame_.point(distance.on_a);
        return {touch.time, distance, false};
    }

    const Convex<D>& set_;
    const SetMotion<D>& motion_;
    Affine<D> frame_, back_;  ///< the function's own frame, and back from it
    DistanceFunction<D> own_;
    PlacedFunction<D> placed_;
    double tolerance_, search_tolerance_;
};

}  // namespace

template <int D>
std::optional<TimedDistance<D>> time_of_impact_by_proofs(const Convex<D>& set, const DistanceFunction<D>& function,
                                                         const SetMotion<D>& motion, double start, double end,
                                                         double tolerance) {
    if (!(function.bounds.min[0] <= function.bounds.max[0])) return std::nullopt;
    return PathSearch<D>(set, function, motion, tolerance).run(start, end);
}

#define ABUT_INSTANTIATE(D)                                                                                         \
    template std::optional<TimedDistance<D>> time_of_impact_by_proofs(const Convex<D>&, const DistanceFunction<D>&, \
                                                                      const SetMotion<D>&, double, double, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
