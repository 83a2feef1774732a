#pragma once

// For how long two parts on their ways surely stay together. For .cpp files.
//
// A point of one of them goes a way x, as the other sees it, of which |x''| <= K, so that a time y after the first and
// z before the last of two it is within K/2 y z of its chord. The other is convex: a point that is outside of it by e1
// and e2 at those times (less than zero inside), h apart, is outside by at most
//
//     e1 z / h + e2 y / h + K/2 y z  <=  e    if K h^2 / 2 <= (sqrt(e - e1) + sqrt(e - e2))^2,
//
// and so far are the two apart at the most. It is the proof of turning_gap.hpp turned round.

#include <abut/math/rigid_path.hpp>
#include <abut/query/felt_normal.hpp>
#include <abut/query/part_pairs.hpp>

namespace abut {

/// In time.
struct Span {
    double from, until;
};

/// Of a pair of parts as the search has it.
template <int D, class Pair>
class Together {
public:
    explicit Together(Pair& pair)
        : pair_(pair),
          speed_(std::min(relative_motion_bounds(pair.a.path(), pair.b.path(), pair.reach_a()).speed,
                          relative_motion_bounds(pair.b.path(), pair.a.path(), pair.reach_b()).speed)) {}

    /// Until when they are surely not apart by more than the margin, at the end of the span at the latest; the distance
    /// at its beginning is less.
    double until(const Span& span, double distance) {
        const double gap = pair_.margin - distance, whole = span.until - span.from;
        // By how fast they are at all.
        if (gap >= speed_ * whole) return span.until;
        const double slow = span.from + gap / speed_;
        if (distance > least_ * pair_.margin) return slow;
        double then = span.until;
        for (int look = 0; look < most_looks && then > slow; ++look) {
            SignedDistance<D> there = pair_.distance(then);
            if (there.distance > most_ * pair_.margin) then = parting({span.from, then}, distance, there);
            if (is_proven({span.from, then}, there)) return std::max(slow, then);
            then = span.from + 0.5 * (then - span.from);
        }
        return slow;
    }

private:
    /// The bound on looks for a span that is proven, each half of the one before, and on looks for where they part.
    static constexpr int most_looks = 16, most_guesses = 32;
    /// Where they part they are apart by more than the one and no more than the other, in margins.
    static constexpr double least_ = 0.2, most_ = 0.5;

    /// A time at which they part, in a span at the end of which they are apart; false position, the Illinois way. Takes
    /// `there` from the end of the span to that time.
    double parting(const Span& span, double first, SignedDistance<D>& there) {
        const double aim = 0.5 * (least_ + most_) * pair_.margin;
        double low = span.from, high = span.until, below = first - aim, above = there.distance - aim;
        int side = 0;
        for (int guess = 0; guess < most_guesses; ++guess) {
            const double time = std::clamp(low + (high - low) * (below / (below - above)), low, high);
            there = pair_.distance(time);
            const double off = there.distance - aim;
            if (std::abs(off) <= 0.5 * (most_ - least_) * pair_.margin) return time;
            if (off < 0) {
                low = time;
                below = off;
                if (side < 0) above *= 0.5;
                side = -1;
            } else {
                high = time;
                above = off;
                if (side > 0) below *= 0.5;
                side = 1;
            }
        }
        there = pair_.distance(low);
        return low;
    }

    /// By a point that they have in common at the end: where they are nearest, or near their middles.
    bool is_proven(const Span& span, const SignedDistance<D>& there) {
        if (!(there.distance <= pair_.margin)) return false;
        pair_.go_to(span.until);
        const DVec<D> of_a = place_near(pair_.here_a(), pair_.here_b()),
                      of_b = place_near(pair_.here_b(), pair_.here_a());
        for (const DVec<D>& point : {there.on_a, of_a})
            if (stays_in<false>(span, point)) return true;
        for (const DVec<D>& point : {there.on_b(), of_b})
            if (stays_in<true>(span, point)) return true;
        return false;
    }

    /// Whether a point of one surely stays within the margin of the other; `point` is where it is at the end.
    template <bool is_of_b>
    bool stays_in(const Span& span, const DVec<D>& point) {
        const RigidPath<D>&path = is_of_b ? pair_.b.path() : pair_.a.path(),
              &frame = is_of_b ? pair_.a.path() : pair_.b.path();
        const auto gap_at = [&](double time, const DVec<D>& there) {
            pair_.go_to(time);
            if constexpr (is_of_b)
                return pair_.margin - outside_of(pair_.here_a(), there);
            else
                return pair_.margin - outside_of(pair_.here_b(), there);
        };
        const double last = gap_at(span.until, point);
        if (!(last >= 0)) return false;
        const Affine<D> place = place_at(path, span.until);
        const DVec<D> own = place.transposed(point - place.offset);
        const double first = gap_at(span.from, place_at(path, span.from).point(own));
        if (!(first >= 0)) return false;
        const double time = span.until - span.from, most = std::sqrt(first) + std::sqrt(last);
        return 0.5 * relative_motion_bounds(path, frame, length(own)).acceleration * time * time <= most * most;
    }

    /// Inside, by no more than is sure.
    template <class Part>
    double outside_of(const Part& part, const DVec<D>& point) const {
        const double distance = foot_on(part, point).distance;
        return distance < 0 ? std::min(distance + pair_.doubt, 0.0) : distance;
    }

    /// The place in a part that is nearest to the middle of another.
    template <class Part, class Other>
    static DVec<D> place_near(const Part& part, const Other& other) {
        const DVec<D> middle = middle_of(other, nearest_to_middle(part));
        const Foot<D> foot = foot_on(part, middle);
        return foot.distance > 0 ? foot.point : middle;
    }
    static DVec<D> nearest_to_middle(const Convex<D>& part) { return middle_of(part, part.place.offset); }
    static DVec<D> nearest_to_middle(const HalfSpaceView<D>& part) { return part.normal * part.offset; }

    Pair& pair_;
    double speed_;  ///< the most at which they may come apart
};

}  // namespace abut
