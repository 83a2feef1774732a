#pragma once

// When what is apart first touches, where whole stretches of the way can be proven free. For .cpp files.
//
// The moment at which the place found touches needs no proof: it is found by the distances of few boxes each. That
// nothing touches before takes a single search in the hull of what moves, over the whole stretch. Where that fails, the
// stretch is cut in two.

#include <abut/convex/gjk/signed_distance.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace abut {

/// The bound on looks, after which the last time that is proven to be free is the answer: early, and never late.
inline constexpr int first_touch_most_looks = 96;

template <int D>
struct Gained {
    double time = 0;
    SignedDistance<D> distance;
    bool started_inside = false;
};

/// Between a time at which they are more than `wanted` apart and one at which they are less. Stops within half of the
/// margin of that; where the distance jumps there is nothing between, and it is the last time at which they are more.
template <int D, class DistanceAt, class Closing>
Gained<D> time_between(Gained<D> before, Gained<D> after, double wanted, double margin, const DistanceAt& distance_at,
                       const Closing& closing) {
    // By regula falsi with the Illinois step: the value at an end that stays twice counts half.
    constexpr int most_looks = 40;
    double above = before.distance.distance - wanted, below = wanted - after.distance.distance;
    int stays = 0;  // how often the end after (above zero) or before (below zero) has stayed
    for (int i = 0; i < most_looks; ++i) {
        if (after.distance.distance >= wanted - 0.5 * margin) return after;
        const double wide = after.time - before.time;
        double time = before.time + 0.5 * wide;
        if (above < std::numeric_limits<double>::infinity()) {
            time = before.time + wide * std::clamp(above / (above + below), 0.01, 0.99);
        } else if (i == 0) {
            const double falls = closing(after.distance, after.time);
            if (falls > 0 && below < falls * wide) time = after.time - below / falls;
        }
        if (!(time > before.time && time < after.time)) break;
        const Gained<D> between{time, distance_at(time), false};
        if (between.distance.distance <= wanted + 0.5 * margin) {
            after = between;
            below = wanted - after.distance.distance;
            stays = std::min(stays, 0) - 1;
            if (stays < -1) above *= 0.5;
        } else {
            before = between;
            above = before.distance.distance - wanted;
            stays = std::max(stays, 0) + 1;
            if (stays > 1) below *= 0.5;
        }
    }
    return after.distance.distance >= wanted - margin ? after : before;
}

/// From a time at which they are apart. distance_at(time) tells a SignedDistance that may be more than the least;
/// closing(distance, time) how fast it falls; is_free(from, until, time) proves that they don't touch between, or tells
/// a time at which they may.
template <int D, class DistanceAt, class Closing, class IsFree>
std::optional<Gained<D>> first_touch(Gained<D> apart, double end, double speed, double margin,
                                     const DistanceAt& distance_at, const Closing& closing, const IsFree& is_free) {
    // Times up to which the way is still to be proven free, the earliest last. `touch` is at the latest.
    std::array<double, static_cast<std::size_t>(first_touch_most_looks) + 1> goals;
    std::size_t count = 1;
    goals[0] = end;
    std::optional<Gained<D>> touch;
    for (int look = 0; look < first_touch_most_looks; ++look) {
        const double goal = goals[count - 1], wide = goal - apart.time;
        double time = goal;
        if (is_free(apart.time, goal, time)) {
            if (count == 1) return touch;
            --count;
            apart = {goal, distance_at(goal), false};
            if (apart.distance.distance <= 0.5 * margin) return apart;
            continue;
        }
        if (wide * speed <= margin) break;
        time = std::clamp(time, apart.time + 0.1 * wide, apart.time + 0.75 * wide);
        const Gained<D> there{time, distance_at(time), false};
        if (there.distance.distance <= 0.5 * margin) {
            touch = time_between(apart, there, 0, margin, distance_at, closing);
            if (!(touch->time > apart.time)) break;
            count = 1;
            goals[0] = touch->time;
        } else {
            goals[count++] = time;
        }
    }
    return apart;
}

}  // namespace abut
