#pragma once

// Judges sweeps of half-spaces and of curved shapes by planes and points.
//
// The set that a convex shape sweeps over in a linear motion is convex. So the shapes miss each other iff a plane
// separates the swept set of A from B: a search finds it, and the formulas of the support values verify it. A hit is
// proven by a point on both shapes. A separating plane up to the time of impact proves that it isn't late.

#include "corpus.hpp"
#include "sweep_judge.hpp"

namespace abut::corpus {

using detail::axis;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;
using detail::to_float;

/// Difficult directions: along the separating plane, towards it, along an axis, or random.
template <int D>
DVec<D> some_way(Random& random, const DVec<D>& normal) {
    const double dice = random.unit();
    const DVec<D> any = random.direction<D>();
    if (dice < 0.3) return any;
    if (dice < 0.55) return normalized(normal + any * random.power_of_two(-30, 1));
    if (dice < 0.65) return axis<D>(static_cast<int>(random.below(D)), random.chance(0.5) ? 1 : -1);
    const DVec<D> along = normalized(any - normal * dot(any, normal), any);
    const double tilt = random.chance(0.5) ? 0 : random.uniform(-1, 1) * random.power_of_two(-24, -1);
    return normalized(along + normal * tilt);
}

/// The lengths of A's motion before and after the pair's position.
struct WayLengths {
    double before, after;
};
inline WayLengths some_lengths(Random& random, double smaller, double larger) {
    const auto length = [&] {
        if (random.chance(0.1)) return smaller * random.power_of_two(-20, -2);
        return (random.chance(0.7) ? larger : smaller) * random.power_of_two(-2, random.chance(0.1) ? 14 : 3);
    };
    const double before = random.chance(0.25) ? 0 : length();
    return {before, random.chance(0.1) ? 0 : length()};
}

/// The known facts about a moving pair.
struct MovingKnown {
    double margin = 0;   ///< the tolerance at the hit
    double smaller = 0;  ///< size
    double sizes = 0;    ///< the sum of the bounded sizes
};

/// A and B are the oracle's shapes of judge.hpp at the start of the motion. `axis_of(view_a)` is nearly the best
/// separating axis for that position of A; it only suggests planes.
template <int D, class A, class B, class AxisOf>
class PlaneJudge {
public:
    PlaneJudge(const View<D>& view_a, const Vec<D>& motion, const View<D>& view_b, const A& a, const B& b,
               const MovingKnown& known, AxisOf axis_of)
        : view_a_(view_a),
          view_b_(view_b),
          a_(a),
          b_(b),
          given_(motion),
          motion_(motion),
          known_(known),
          axis_of_(axis_of),
          first_axis_(axis_at(0)) {}

    SweepVerdict judge() {
        const std::optional<Hit<D>> hit = sweep(view_a_, given_, view_b_);
        const double start = gap(first_axis_, 0);
        verdict_.hit = hit.has_value();
        verdict_.touches_at_start = start <= known_.margin;
        if (hit)
            judge_hit(*hit, start);
        else
            judge_miss(start);
        return verdict_;
    }

private:
    DVec<D> axis_at(double fraction) const {
        detail::Affine<D> shift;
        shift.offset = motion_ * fraction;
        return axis_of_(moved(view_a_, shift));
    }
    /// The gap along n, from A to B, at a fraction of the motion.
    double gap(const DVec<D>& n, double fraction) const {
        return -(a_.extent(n) + b_.extent(-n)) - fraction * dot(n, motion_);
    }

    void judge_hit(const Hit<D>& hit, double start) {
        const double fraction = static_cast<double>(hit.fraction), way = length(motion_);
        const DVec<D> out(hit.normal), point(hit.point), n = -normalized(out);
        // A fraction is a float.
        const double margin = known_.margin + 1e-7 * fraction * way;
        verdict_.expect(hit.fraction >= 0 && hit.fraction <= 1 && std::abs(length(out) - 1) <= 1e-6,
                        "no fraction or normal", hit.fraction);
        verdict_.expect(dot(n, motion_) > -1e-6 * way, "the normal doesn't face the mover", dot(n, motion_) / way);
        verdict_.expect(std::abs(static_cast<double>(hit.distance) - fraction * way) <= 1e-6 * way,
                        "the distance isn't that of the fraction", hit.distance);
        if (start < -known_.margin) {
            verdict_.fail(verdict_.late, fraction > 0, "late by all, begun inside", fraction);
            return;
        }
        const double off_a = a_.beyond(point - motion_ * fraction), off_b = b_.beyond(point);
        const double limit = margin + 2 * oracle::rounding_of(hit.point);
        verdict_.worst = std::max(off_a, off_b) / limit;
        verdict_.fail(verdict_.false_hit, off_a > limit, "the point is not on A", off_a / limit);
        verdict_.fail(verdict_.false_hit, off_b > limit, "the point is not on B", off_b / limit);
        // Rounding rotates a normal by about 1e-7.
        const double deep = -gap(n, fraction) - margin - 1e-7 * known_.sizes;
        verdict_.fail(verdict_.late, deep > 0, "the normal is not of a plane between them", deep / known_.margin);
        const bool leaves = fraction == 0 && dot(first_axis_, motion_) < -1e-3 * way;
        verdict_.fail(verdict_.false_hit, leaves && known_.smaller > 200 * known_.margin, "moves away", start);
    }

    void judge_miss(double start) {
        if (start < -known_.margin) {
            // A curved shape may have other directions out.
            const bool one_way_out = std::is_same_v<A, HalfSpaceSide<D>> || std::is_same_v<B, HalfSpaceSide<D>>;
            const double deeper = dot(first_axis_, motion_);
            verdict_.fail(verdict_.missed, one_way_out && deeper > known_.margin && !slides(), "goes deeper", deeper);
            return;
        }
        const double parted = most_parted(), deep = -known_.margin - parted;
        // A thin shape that touches at the start may separate on either side.
        const bool is_undecided =
            start <= known_.margin && (slides() || gap(nearest_axis_, nearest_) >= -known_.margin);
        verdict_.fail(verdict_.missed, deep > 0 && !is_undecided, "goes in or through", deep / known_.margin);
    }

    /// Whether the shape slides: an approach so slow at the start stays below the tolerance, because distance is
    /// convex.
    bool slides() const { return dot(first_axis_, motion_) <= 1e-6 * length(motion_); }

    double parted_along(const DVec<D>& n) const { return std::min(gap(n, 0), gap(n, 1)); }

    /// The gap of one plane over the whole motion: the best found, or one that is wide enough.
    double most_parted() {
        const double way = length(motion_);
        DVec<D> best = first_axis_, last = axis_at(1);
        const auto offer = [&](const DVec<D>& n) {
            if (parted_along(n) > parted_along(best)) best = n;
        };
        offer(last);
        // The distance decreases until the nearest fraction and increases after it.
        double low = 0, high = 1;
        DVec<D> before = first_axis_, after = last;
        while (dot(before, motion_) > 0 && dot(after, motion_) < 0 && (high - low) * way > 1e-3 * known_.margin) {
            const double middle = 0.5 * (low + high);
            if (!(middle > low && middle < high)) break;
            const DVec<D> n = axis_at(middle);
            (dot(n, motion_) > 0 ? low : high) = middle;
            (dot(n, motion_) > 0 ? before : after) = n;
        }
        nearest_ = gap(before, low) < gap(after, high) ? low : high;
        nearest_axis_ = nearest_ == low ? before : after;
        const double closes = dot(before, motion_), opens = -dot(after, motion_);
        if (closes > 0 && opens > 0) offer(normalized(before * opens + after * closes, before));
        for (const DVec<D>& n : {before, after}) offer(normalized(n - motion_ * (dot(n, motion_) / (way * way)), n));
        Random random(1);
        for (double step = 0.1; step > 1e-8 && parted_along(best) < -known_.margin; step *= 0.97)
            for (int i = 0; i < 4; ++i) offer(normalized(best + random.in_cube<D>() * step));
        return parted_along(best);
    }

    const View<D>&view_a_, &view_b_;
    const A& a_;
    const B& b_;
    Vec<D> given_;
    DVec<D> motion_;
    MovingKnown known_;
    AxisOf axis_of_;
    DVec<D> first_axis_, nearest_axis_{0.0};
    double nearest_ = 0;
    SweepVerdict verdict_;
};

/// Either the shape moves, or the half-space.
template <int D>
SweepVerdict judged_sweep_at_half_space(Random random) {
    HalfSpacePair<D> pair = half_space_pair<D>(Random(random.bits()));
    const DVec<D> given(pair.half_space.normal), up = normalized(given);
    const double size = oracle::size(pair.sample.solid), least = std::max(size, 1e-4);
    const DVec<D> way = some_way(random, up * (pair.sample_first ? -1.0 : 1.0));
    const WayLengths lengths = some_lengths(random, least, least);
    const Vec<D> motion = to_float(way * (lengths.before + lengths.after));
    if (motion == Vec<D>(0.0f)) return {};
    const Sample<D> sample = shifted(pair.sample, way * (pair.sample_first ? -lengths.before : lengths.before));

    const DVec<D> origin = oracle::middle(pair.sample.solid);
    const PolytopeSide<D> shape(sample, origin);
    const HalfSpaceSide<D> ground{up, static_cast<double>(pair.half_space.offset) / length(given), origin};
    const MovingKnown known{1e-5 * size + 16 * oracle::ulp(2 * size) + oracle::transform_error(sample.solid), size,
                            size};
    const View<D> view_of_ground = view(pair.half_space);
    if (pair.sample_first)
        return PlaneJudge(sample.view, motion, view_of_ground, shape, ground, known,
                          [&](const View<D>&) { return -up; })
            .judge();
    return PlaneJudge(view_of_ground, motion, sample.view, ground, shape, known, [&](const View<D>&) { return up; })
        .judge();
}

template <int D>
RoundShape<D> shifted(RoundShape<D> shape, const DVec<D>& by) {
    detail::Affine<D> shift;
    shift.offset = by;
    shape.view = moved(shape.view, shift);
    shape.place.offset += by;
    return shape;
}

template <int D>
SweepVerdict judged_round_sweep(Random random) {
    const RoundPair<D> pair = round_pair<D>(random);
    const DVec<D> origin = pair.a.place.offset;
    const auto axis_to = [](const View<D>& a, const View<D>& b) {
        const Closest<D> found = closest(a, b);
        return all_finite<D>(found.normal) ? normalized(DVec<D>(found.normal), axis<D>(0)) : axis<D>(0);
    };
    const double size_a = pair.a.size(), size_b = pair.b.size(), smaller = std::min(size_a, size_b);
    const DVec<D> way = some_way(random, axis_to(pair.a.view, pair.b.view));
    const WayLengths lengths = some_lengths(random, smaller, std::max(size_a, size_b));
    const Vec<D> motion = to_float(way * (lengths.before + lengths.after));
    if (motion == Vec<D>(0.0f)) return {};

    const double reach = size_a + length(pair.b.place.offset - origin) + 2 * size_b;
    const MovingKnown known{1e-5 * smaller + 16 * oracle::ulp(reach) + 1e-14 * detail::largest(origin), smaller,
                            size_a + size_b};
    const RoundShape<D> mover = shifted(pair.a, way * -lengths.before);
    const RoundSide<D> a{mover, origin}, b{pair.b, origin};
    return PlaneJudge(mover.view, motion, pair.b.view, a, b, known,
                      [&](const View<D>& there) { return axis_to(there, pair.b.view); })
        .judge();
}

}  // namespace abut::corpus
