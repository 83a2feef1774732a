#pragma once

// The time of impact of shapes that start apart, if whole intervals of the motion can be proven free of contact. For
// .cpp files.
//
// The time at which the point found touches needs no proof: a few evaluations of the distance find it. One search in
// the hull of the moving set proves that nothing touches before. If the proof fails, the interval is split.

#include <abut/convex/gjk/signed_distance.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace abut::detail {

/// The limit on iterations. At the limit the answer is the last time proven free of contact, which is early and never
/// late.
inline constexpr int interval_search_max_iterations = 96;

template <int D>
struct TimedDistance {
    double time = 0;
    SignedDistance<D> distance;
    bool started_inside = false;
};

/// Finds the time at which the distance is `target`, between a time with more and a time with less. It stops within
/// half of the margin. If the distance jumps, the answer is the last time with more.
template <int D, class DistanceAt, class Closing>
TimedDistance<D> time_at_distance(TimedDistance<D> before, TimedDistance<D> after, double target, double tolerance,
                                  const DistanceAt& distance_at, const Closing& closing) {
    // Regula falsi with the Illinois step: the value at an end that stays twice counts half.
    constexpr int max_iterations = 40;
    double above = before.distance.distance - target, below = target - after.distance.distance;
    int repeats = 0;  // how often the end after (positive) or before (negative) has stayed
    for (int i = 0; i < max_iterations; ++i) {
        if (after.distance.distance >= target - 0.5 * tolerance) return after;
        const double interval = after.time - before.time;
        double time = before.time + 0.5 * interval;
        if (above < std::numeric_limits<double>::infinity()) {
            time = before.time + interval * std::clamp(above / (above + below), 0.01, 0.99);
        } else if (i == 0) {
            const double closing_speed = closing(after.distance, after.time);
            if (closing_speed > 0 && below < closing_speed * interval) time = after.time - below / closing_speed;
        }
        if (!(time > before.time && time < after.time)) break;
        const TimedDistance<D> between{time, distance_at(time), false};
        if (between.distance.distance <= target + 0.5 * tolerance) {
            after = between;
            below = target - after.distance.distance;
            repeats = std::min(repeats, 0) - 1;
            if (repeats < -1) above *= 0.5;
        } else {
            before = between;
            above = before.distance.distance - target;
            repeats = std::max(repeats, 0) + 1;
            if (repeats > 1) below *= 0.5;
        }
    }
    return after.distance.distance >= target - tolerance ? after : before;
}

/// Starts at a time at which the shapes are apart. distance_at(time) returns a SignedDistance, which may exceed the
/// minimum; closing(distance, time) returns how fast it falls. is_free(from, until, time) proves that there is no
/// contact in an interval, or sets a time at which there may be.
template <int D, class DistanceAt, class Closing, class IsFree>
std::optional<TimedDistance<D>> time_of_impact_by_intervals(TimedDistance<D> apart, double end, double speed,
                                                            double tolerance, const DistanceAt& distance_at,
                                                            const Closing& closing, const IsFree& is_free) {
    // Ends of intervals that are still to be proven free, the earliest last. `impact` is at the latest of them.
    std::array<double, static_cast<std::size_t>(interval_search_max_iterations) + 1> goals;
    std::size_t count = 1;
    goals[0] = end;
    std::optional<TimedDistance<D>> impact;
    for (int iteration = 0; iteration < interval_search_max_iterations; ++iteration) {
        const double goal = goals[count - 1], interval = goal - apart.time;
        double time = goal;
        if (is_free(apart.time, goal, time)) {
            if (count == 1) return impact;
            --count;
            apart = {goal, distance_at(goal), false};
            if (apart.distance.distance <= 0.5 * tolerance) return apart;
            continue;
        }
        if (interval * speed <= tolerance) break;
        time = std::clamp(time, apart.time + 0.1 * interval, apart.time + 0.75 * interval);
        const TimedDistance<D> probe{time, distance_at(time), false};
        if (probe.distance.distance <= 0.5 * tolerance) {
            impact = time_at_distance(apart, probe, 0, tolerance, distance_at, closing);
            if (!(impact->time > apart.time)) break;
            count = 1;
            goals[0] = impact->time;
        } else {
            goals[count++] = time;
        }
    }
    return apart;
}

}  // namespace abut::detail
