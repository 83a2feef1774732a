#pragma once

// How long two moving parts certainly stay in contact. For .cpp files.
//
// A point of one part follows a path x relative to the other, with |x''| <= K. At a time y after the start and z before
// the end of an interval it is within K/2 y z of its chord. The other part is convex. If the point is outside of it by
// e1 at the start and e2 at the end (negative inside), and the interval has length h, then it is outside by at most
//
//    e1 z / h + e2 y / h + K/2 y z  <=  e    if K h^2 / 2 <= (sqrt(e - e1) + sqrt(e - e2))^2,
//
// and so the gap is at most e. This is the converse of the proof in convex/toi/separation_function.hpp.

#include <abut/math/detail/rigid_path.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/surface/closest_points.hpp>

#include <limits>

namespace abut::detail {

/// An interval of time.
struct TimeSpan {
    double from, until;
};

/// Proofs of contact for a pair of parts of RotatingSweep.
template <int D, class Pair>
class ContactInterval {
public:
    explicit ContactInterval(Pair& pair)
        : pair_(pair),
          speed_(std::min(speed_of(pair.a.path(), pair.b.path(), pair.reach_a()),
                          speed_of(pair.b.path(), pair.a.path(), pair.reach_b()))) {}

    /// The time until which the gap certainly stays within the tolerance, at most the end of the span. `distance` is
    /// that at the start, and less.
    double until(const TimeSpan& span, double distance) {
        const double gap = pair_.tolerance - distance, duration = span.until - span.from;
        // The bound by the maximum speed.
        if (gap >= speed_ * duration) return span.until;
        const double slow = span.from + gap / speed_;
        if (distance > min_gap_ * pair_.tolerance) return slow;
        double end = span.until;
        for (int attempt = 0; attempt < max_attempts && end > slow; ++attempt) {
            SignedDistance<D> at_end = pair_.distance(end);
            if (at_end.distance > max_gap_ * pair_.tolerance) end = separation_time({span.from, end}, distance, at_end);
            if (is_proven({span.from, end}, at_end)) return std::max(slow, end);
            end = span.from + 0.5 * (end - span.from);
        }
        return slow;
    }

private:
    /// An upper bound by the points of one part. A half-space has points at any distance, which bound nothing.
    static double speed_of(const RigidPath<D>& path, const RigidPath<D>& frame, double reach) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return reach < infinity ? relative_motion_bounds(path, frame, reach).speed : infinity;
    }

    /// The limits on trials of a span, each half as long as the last, and on iterations for the time of separation.
    static constexpr int max_attempts = 16, max_iterations = 32;
    /// At the time of separation the gap is between these, in tolerances.
    static constexpr double min_gap_ = 0.2, max_gap_ = 0.5;

    /// A time at which the parts separate, in a span at whose end they are apart (regula falsi with the Illinois step).
    /// Moves `at_end` from the end of the span to that time.
    double separation_time(const TimeSpan& span, double first, SignedDistance<D>& at_end) {
        const double aim = 0.5 * (min_gap_ + max_gap_) * pair_.tolerance;
        double low = span.from, high = span.until, below = first - aim, above = at_end.distance - aim;
        int side = 0;
        for (int iteration = 0; iteration < max_iterations; ++iteration) {
            const double time = std::clamp(low + (high - low) * (below / (below - above)), low, high);
            at_end = pair_.distance(time);
            const double error = at_end.distance - aim;
            if (std::abs(error) <= 0.5 * (max_gap_ - min_gap_) * pair_.tolerance) return time;
            if (error < 0) {
                low = time;
                below = error;
                if (side < 0) above *= 0.5;
                side = -1;
            } else {
                high = time;
                above = error;
                if (side > 0) below *= 0.5;
                side = 1;
            }
        }
        at_end = pair_.distance(low);
        return low;
    }

    /// Proves contact by a common point at the end of the span: the closest points, or points near the centres.
    bool is_proven(const TimeSpan& span, const SignedDistance<D>& at_end) {
        if (!(at_end.distance <= pair_.tolerance)) return false;
        pair_.go_to(span.until);
        const DVec<D> of_a = nearest_place(pair_.here_a(), pair_.here_b()),
                      of_b = nearest_place(pair_.here_b(), pair_.here_a());
        for (const DVec<D>& point : {at_end.on_a, of_a})
            if (stays_in<false>(span, point)) return true;
        for (const DVec<D>& point : {at_end.on_b(), of_b})
            if (stays_in<true>(span, point)) return true;
        return false;
    }

    /// Whether a point of one part certainly stays within the tolerance of the other; `point` is its position at the
    /// end.
    template <bool is_of_b>
    bool stays_in(const TimeSpan& span, const DVec<D>& point) {
        const RigidPath<D>&path = is_of_b ? pair_.b.path() : pair_.a.path(),
              &frame = is_of_b ? pair_.a.path() : pair_.b.path();
        const auto gap_at = [&](double time, const DVec<D>& position) {
            pair_.go_to(time);
            if constexpr (is_of_b)
                return pair_.tolerance - outside_of(pair_.here_a(), position);
            else
                return pair_.tolerance - outside_of(pair_.here_b(), position);
        };
        const double last = gap_at(span.until, point);
        if (!(last >= 0)) return false;
        const Affine<D> place = place_at(path, span.until);
        const DVec<D> own = place.transposed(point - place.offset);
        const double first = gap_at(span.from, place_at(path, span.from).point(own));
        if (!(first >= 0)) return false;
        const double time = span.until - span.from, root_sum = std::sqrt(first) + std::sqrt(last);
        return 0.5 * relative_motion_bounds(path, frame, length(own)).acceleration * time * time <= root_sum * root_sum;
    }

    /// A negative distance is reduced by the error of a depth.
    double outside_of(const AnyPart<D>& part, const DVec<D>& point) const {
        const double distance = closest_point_on(part, point).distance;
        return distance < 0 ? std::min(distance + pair_.depth_error, 0.0) : distance;
    }

    /// The point of a part nearest to the centre of another part.
    static DVec<D> nearest_place(const Part<D>& part, const Part<D>& other) {
        const DVec<D> middle = middle_of(other, nearest_to_middle(part));
        const ClosestPoint<D> closest = closest_point_on(part, middle);
        return closest.distance > 0 ? closest.point : middle;
    }
    static DVec<D> nearest_to_middle(const Part<D>& part) {
        if (part.is_half_space()) return part.half_space().normal * part.half_space().offset;
        return middle_of(part, DVec<D>(0.0));
    }

    Pair& pair_;
    double speed_;  ///< an upper bound of the speed of separation
};

}  // namespace abut::detail
