#pragma once

// Judges sweeps of the corpus's pairs by the oracle's distances.
//
// The signed distance of convex shapes is a convex function along a linear motion. So tangents, each from an exact
// distance and its normal, find its minimum. The distance of the two projections along the motion decides whether the
// motion passes through the other shape, however thin.

#include "pairs.hpp"
#include <abut/query/sweep.hpp>

#include <sstream>
#include <string>

namespace abut::corpus {

using detail::axis;
using detail::cross;
using detail::dot;
using detail::DVec;
using detail::length;
using detail::normalized;
using detail::perpendicular;
using detail::to_float;

/// A pair and the motion of its first shape.
template <int D>
struct MovingPair {
    Sample<D> a, b;
    Vec<D> motion;
};

template <int D>
Sample<D> shifted(const Sample<D>& sample, const DVec<D>& by) {
    detail::Affine<D> shift;
    shift.offset = by;
    return {sample.kind, sample.owner, moved(sample.view, shift), oracle::mapped(sample.solid, shift)};
}

/// A difficult direction: along the surface, towards it, along an axis, or along an edge of either shape.
template <int D>
DVec<D> some_way(Random& random, const SamplePair<D>& pair, const DVec<D>& normal) {
    const double dice = random.unit();
    const DVec<D> any = random.direction<D>();
    if (dice < 0.3) return any;
    if (dice < 0.5) return normalized(normal + any * random.power_of_two(-30, 1));
    const DVec<D> along = normalized(any - normal * dot(any, normal), any);
    if (dice < 0.75)
        return normalized(along +
                          normal * (random.chance(0.5) ? 0 : random.uniform(-1, 1) * random.power_of_two(-24, -1)));
    if (dice < 0.85) return axis<D>(static_cast<int>(random.below(D)), random.chance(0.5) ? 1 : -1);
    const Polytope<D>& solid = random.chance(0.5) ? pair.a.solid : pair.b.solid;
    if (solid.edges.empty()) return any;
    const auto& [i, j] = solid.edges[random.below(static_cast<std::uint32_t>(solid.edges.size()))];
    const auto corners = oracle::corners_relative_to(solid, oracle::middle(solid));
    return normalized(corners[j] - corners[i], any);
}

/// The motion of A passes the pair's position: it starts there, nearby, or up to about ten thousand sizes away.
template <int D>
MovingPair<D> set_in_motion(const SamplePair<D>& pair, Random random) {
    const Truth<D> there = oracle::truth(pair.a.solid, pair.b.solid, Arithmetic::floating_point);
    const DVec<D> way = some_way(random, pair, there.normal);
    const double larger = std::max(oracle::size(pair.a.solid), oracle::size(pair.b.solid));
    // A point has no size.
    const double least = std::max(10 * oracle::tolerance_for(pair.a.solid, pair.b.solid), 1e-4);
    const double smaller = std::max(smaller_size(pair.a, pair.b), least);
    const auto length = [&] {
        if (random.chance(0.1)) return smaller * random.power_of_two(-20, -2);
        return (random.chance(0.7) ? std::max(larger, least) : smaller) *
               random.power_of_two(-2, random.chance(0.1) ? 14 : 3);
    };
    const double before = random.chance(0.25) ? 0 : length(), after = random.chance(0.1) ? 0 : length();
    return {shifted(pair.a, way * -before), pair.b, to_float(way * (before + after))};
}

/// The projection of a shape along a direction, in a frame of the perpendicular plane.
inline Polytope<2> shadow(const Polytope<3>& solid, const DVec<3>& origin, const DVec<3>& u, const DVec<3>& v) {
    std::vector<Vec2> points;
    for (const DVec<3>& p : oracle::corners_relative_to(solid, origin))
        points.push_back(to_float(DVec<2>(dot(u, p), dot(v, p))));
    return oracle::hull_of<2>(std::move(points), solid.radius);
}
inline double shadow_distance(const Polytope<3>& a, const Polytope<3>& b, const DVec<3>& way) {
    const DVec<3> u = perpendicular(way), v = cross(way, u), origin = oracle::middle(b);
    return oracle::truth(shadow(a, origin, u, v), shadow(b, origin, u, v), Arithmetic::floating_point).distance;
}
inline double shadow_distance(const Polytope<2>& a, const Polytope<2>& b, const DVec<2>& way) {
    const DVec<2> across = perpendicular(way);
    return std::max(oracle::gap_along(a, b, across), oracle::gap_along(a, b, -across)) - a.radius - b.radius;
}

/// The verdict on one pair.
struct SweepVerdict {
    bool hit = false, touches_at_start = false, missed = false, late = false, false_hit = false;
    double worst = 0;   ///< distance at the fraction, relative to the tolerance
    std::string story;  ///< a description of the error; empty if there is none

    void expect(bool right, const char* what, double value) {
        if (right) return;
        std::ostringstream line;
        line << "    " << what << ": " << value << '\n';
        story += line.str();
    }
    void fail(bool& kind, bool wrong, const char* what, double value) {
        kind = kind || wrong;
        expect(!wrong, what, value);
    }
};

template <int D>
class SweepJudge {
public:
    explicit SweepJudge(const MovingPair<D>& pair)
        : pair_(pair),
          motion_(pair.motion),
          size_(smaller_size(pair.a, pair.b)),
          margin_(oracle::tolerance_for(pair.a.solid, pair.b.solid)) {}

    /// Judges the answer of `sweep`.
    SweepVerdict judge(const std::optional<Hit<D>>& hit) {
        verdict_.hit = hit.has_value();
        const Moment start = at(0);
        verdict_.touches_at_start = start.distance <= margin_;
        if (hit)
            judge_hit(*hit, start);
        else
            judge_miss(start);
        return verdict_;
    }

private:
    struct Moment {
        double fraction, distance;
        double slope;  ///< the derivative of the distance by the fraction
    };

    Moment at(double fraction) const {
        const Truth<D> now = truth_at(fraction);
        Moment result{fraction, now.distance, -dot(motion_, now.normal)};
        // At contact, the direction between the closest points is dominated by rounding.
        const double step = (1e-5 * size_ + 1e-2 * margin_) / length(motion_);
        if (std::abs(now.distance) < 0.01 * margin_ && step > 0) {
            const double secant = (truth_at(fraction + step).distance - now.distance) / step;
            result.slope = secant < 0 ? secant : std::min(result.slope, secant);
        }
        return result;
    }
    Truth<D> truth_at(double fraction) const {
        return oracle::truth(a_at(fraction), pair_.b.solid, Arithmetic::floating_point);
    }
    Polytope<D> a_at(double fraction) const {
        detail::Affine<D> shift;
        shift.offset = motion_ * fraction;
        return oracle::mapped(pair_.a.solid, shift);
    }

    /// The fraction between two others at which the distance is minimal, to a hundredth of the tolerance, or until
    /// `enough` holds.
    Moment least(Moment left, Moment right, double enough) const {
        for (int step = 0; step < 60; ++step) {
            const Moment& lower = left.distance < right.distance ? left : right;
            if (left.slope >= 0) return left;
            if (right.slope <= 0) return right;
            if (lower.distance < enough) return lower;
            const double way = right.fraction - left.fraction;
            const double along =
                std::clamp((left.distance - right.distance + right.slope * way) / (right.slope - left.slope), 0.0, way);
            const double bound = left.distance + left.slope * along;
            if (bound > lower.distance - 0.01 * margin_ || !(along > 0 && along < way)) return lower;
            const Moment between = at(left.fraction + along);
            (between.slope < 0 ? left : right) = between;
        }
        return left.distance < right.distance ? left : right;
    }

    void judge_hit(const Hit<D>& hit, const Moment& start) {
        const double fraction = static_cast<double>(hit.fraction);
        const Moment then = at(fraction);
        // A fraction is a float.
        const double margin = margin_ + 1e-7 * fraction * length(motion_);
        const DVec<D> normal(hit.normal);
        expect(hit.fraction >= 0 && hit.fraction <= 1 && std::abs(length(normal) - 1) <= 1e-6, "no fraction or normal",
               hit.fraction);
        expect(dot(normal, motion_) < 1e-6 * length(motion_), "the normal doesn't face the mover",
               dot(normal, motion_));
        expect(std::abs(static_cast<double>(hit.distance) - fraction * length(motion_)) <= 1e-6 * length(motion_),
               "the distance isn't that of the fraction", hit.distance);
        if (start.distance < -margin_) {
            if (fraction > 0) fail(verdict_.late, "late by all, begun inside", fraction);
            if (was_rising(start)) fail(verdict_.false_hit, "moves out", start.distance);
            expect(hit.started_inside, "started inside", start.distance);
            return;
        }
        expect(!hit.started_inside || start.distance < 0, "did not start inside", start.distance);
        verdict_.worst = std::abs(then.distance) / margin;
        if (then.distance > margin) fail(verdict_.false_hit, "not there yet, or never", then.distance / margin);
        if (then.distance < -margin) fail(verdict_.late, "already in", then.distance / margin);
        if (then.slope > 0) {
            const double deepest = least(start, then, -margin).distance;
            if (deepest < -margin) fail(verdict_.late, "was deeper before", deepest / margin);
        }
        if (fraction == 0 && start.distance <= margin_) {
            const double farther = std::max(1.0, (0.2 * size_ + 50 * margin_) / length(motion_));
            const double deepest = least(start, at(farther), start.distance - margin_).distance;
            const double shallow = std::min(start.distance, 0.0) - 0.01 * margin_;
            // A deep overlap may separate in several directions, or grow slowly; so may one of a shape near the
            // tolerance.
            const bool is_undecided = size_ < 200 * margin_ || (start.distance < -0.01 * margin_ &&
                                                                dot(normal, motion_) < -1e-9 * length(motion_));
            if (deepest >= shallow && !is_undecided) fail(verdict_.false_hit, "doesn't go in", deepest / margin_);
        }
        const double gap =
            oracle::gap_along(a_at(fraction), pair_.b.solid, -normal) - pair_.a.solid.radius - pair_.b.solid.radius;
        expect(gap >= -margin - 1e-6 * (oracle::size(pair_.a.solid) + oracle::size(pair_.b.solid)),
               "the normal is not of a plane between them", gap / margin);
        const double rounding = 2 * oracle::rounding_of(hit.point) + margin + std::abs(then.distance);
        expect(off(a_at(fraction), hit.point) <= rounding, "the point is not on A",
               off(a_at(fraction), hit.point) / rounding);
        expect(off(pair_.b.solid, hit.point) <= rounding, "the point is not on B",
               off(pair_.b.solid, hit.point) / rounding);
    }

    void judge_miss(const Moment& start) {
        if (start.distance < -margin_) {
            const bool by_support = pair_.a.kind == Kind::cloud || pair_.b.kind == Kind::cloud;
            if (!by_support && falls(start)) fail(verdict_.missed, "goes deeper", start.distance);
            return;
        }
        const bool apart = start.distance > margin_;
        const Moment deepest = least(start, at(1), -margin_);
        if (deepest.distance < -margin_) fail(verdict_.missed, "goes in", deepest.distance / margin_);
        // The motion passes through the other shape, however thin it is.
        if (apart && deepest.distance <= 1e-3 * margin_ && at(1).distance > margin_) {
            const double deep = shadow_distance(pair_.a.solid, pair_.b.solid, normalized(motion_));
            if (deep < -2 * margin_) fail(verdict_.missed, "goes through", deep / margin_);
        }
    }

    /// Whether the distance clearly decreases from the start, along each direction out.
    bool falls(const Moment& start) const {
        const double step = 1e-3 * size_;
        return start.distance - at(step / length(motion_)).distance > 1e-3 * step + 0.05 * margin_;
    }
    /// Whether the distance clearly increases before the start.
    bool was_rising(const Moment& start) const {
        const double step = 1e-3 * size_;
        return start.distance - at(-step / length(motion_)).distance > 1e-3 * step + 0.05 * margin_;
    }

    static double off(const Polytope<D>& solid, const Vec<D>& point) {
        return std::abs(oracle::truth(solid, oracle::hull_of<D>({point}), Arithmetic::floating_point).distance);
    }

    void fail(bool& kind, const char* what, double value) { verdict_.fail(kind, true, what, value); }
    void expect(bool right, const char* what, double value) { verdict_.expect(right, what, value); }

    const MovingPair<D>& pair_;
    DVec<D> motion_;
    double size_, margin_;
    SweepVerdict verdict_;
};

}  // namespace abut::corpus
