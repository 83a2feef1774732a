#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/toi/separation_function.hpp>
#include <abut/convex/tolerance.hpp>
#include <abut/math/detail/rigid_path.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/one_sided.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/surface/closest_points.hpp>
#include <abut/query/detail/sweep/rotating.hpp>

#include <limits>

namespace abut::detail {
namespace {

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
        const double gap = pair_.tolerance - distance, duration = span.to - span.from;
        // The bound by the maximum speed.
        if (gap >= speed_ * duration) return span.to;
        const double slow = span.from + gap / speed_;
        if (distance > min_gap_ * pair_.tolerance) return slow;
        double end = span.to;
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
        double low = span.from, high = span.to, below = first - aim, above = at_end.distance - aim;
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
        pair_.go_to(span.to);
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
        const double last = gap_at(span.to, point);
        if (!(last >= 0)) return false;
        const Affine<D> place = place_at(path, span.to);
        const DVec<D> own = place.transposed(point - place.offset);
        const double first = gap_at(span.from, place_at(path, span.from).point(own));
        if (!(first >= 0)) return false;
        const double time = span.to - span.from, root_sum = square_root(first) + square_root(last);
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

/// From this iteration on, each one tries all axes.
constexpr int fast_iterations = 4;

/// The bounding radius, directly from the core if possible, without its extents.
template <int D>
double radius_of(const Convex<D>& set) {
    if (is_plain_box(set)) return length(DVec<D>(set.own[0])) * set.scale + set.radius;
    return size(set);
}

/// With the smallest ulp possible: coordinates as large as the larger part.
double tolerance_of(double size_a, double size_b) {
    return tolerance_for(std::min(size_a, size_b), std::max(size_a, size_b));
}

/// By how much a computed depth may exceed the least depth.
template <int D>
double depth_error_of(const Convex<D>& set) {
    const bool exact = set.inner_radius == 0 && (set.core == Core::points || set.core == Core::box);
    return exact ? 0 : 1e-3 * radius_of(set);
}

template <int D>
class ConvexPair {
public:
    ConvexPair(const Convex<D>& set_a, const RigidPath<D>& path_a, const Convex<D>& set_b, const RigidPath<D>& path_b,
               const SearchOptions<D>& options)
        : tolerance(tolerance_of(radius_of(set_a), radius_of(set_b))),
          a(set_a, path_a, 0.02 * tolerance),
          b(set_b, path_b, 0.02 * tolerance),
          depth_error(depth_error_of(set_a) + depth_error_of(set_b)),
          options_(options) {
        if (options_.cache == nullptr) options_.cache = &cache_;
    }

    SignedDistance<D> distance(double time) {
        go_to(time);
        return part_distance(a.here(), b.here(), options_);
    }
    Manifold<D> contact_points(const SignedDistance<D>& distance) const {
        return manifold(a.here(), b.here(), distance, tolerance);
    }

    /// The time until which the gap is certainly open, along the axis across the closest features. Parts that touch,
    /// and searches that don't progress, also try axes that stand still or rotate with one of the parts.
    double separated_to(double from, double until, double level, double step_tolerance, const SignedDistance<D>& now,
                        bool try_all_axes) {
        const AngularVelocity<D> still{};
        const AngularVelocity<D> across = axis_angular_velocity(a, b, now.normal, now.corners);
        double time = follow(across, from, until, level, step_tolerance, now);
        if (time >= until || !try_all_axes) return time;
        for (const AngularVelocity<D>& angular_velocity : {still, a.path().angular_velocity, b.path().angular_velocity})
            if (angular_velocity != across)
                time = std::max(time, follow(angular_velocity, from, until, level, step_tolerance, now));
        return time;
    }

    void go_to(double time) {
        a.go_to(time);
        b.go_to(time);
    }
    const Convex<D>& here_a() const { return a.here(); }
    const Convex<D>& here_b() const { return b.here(); }
    double reach_a() const { return a.reach(); }
    double reach_b() const { return b.reach(); }

    /// Whether the separating direction is certainly unique: for round parts, and in the plane if the contact is inside
    /// an edge.
    bool has_unique_normal(const SignedDistance<D>& now) const {
        if (a.here().radius + b.here().radius > far_from_end * tolerance) return true;
        return D == 2 && (is_inside_edge(a.here(), now.corners, now.corners.a, now.on_a) ||
                          is_inside_edge(b.here(), now.corners, now.corners.b, now.on_b()));
    }

    Feature feature_on_b(const SignedDistance<D>& distance) const {
        Feature result;
        name_feature(b.here(), distance.corners.b, distance.corners.count, -distance.normal, 0, result);
        return result;
    }

    double tolerance;
    RotatingSet<D> a, b;
    double depth_error;  ///< by how much a depth may exceed the least depth

private:
    static constexpr double far_from_end = 10;  ///< from an end, in tolerances

    /// For a core with corners: whether the point is far from each of the corners that it lies between.
    bool is_inside_edge(const Convex<D>& set, const ClosestCorners<D>& closest, const CornerIndices<D>& corners,
                        const DVec<D>& place) const {
        if (corners[0] == corners[1] || closest.count < 2) return false;
        bool result = true;
        for (std::size_t i = 0; i < closest.count; ++i)
            result = result && has_corner(set, corners[i]) &&
                     length_squared(set.place.point(local_corner(set, corners[i])) - place) >
                         far_from_end * far_from_end * tolerance * tolerance;
        return result;
    }

    double follow(const AngularVelocity<D>& angular_velocity, double from, double until, double level,
                  double step_tolerance, const SignedDistance<D>& now) {
        SeparationFunction<D> gap(a, b, now.normal, angular_velocity, from);
        return separated_until(gap, from, until, gap.at_first(now.normal, now.distance, now.on_a, now.on_b()), level,
                               step_tolerance)
            .time;
    }

    SearchOptions<D> options_;
    Cache cache_;
};

/// A set and a half-space, in either order. The normal of the border is the only separating axis and gives the distance
/// in closed form. A point of the border stands for the half-space.
template <int D>
class HalfSpacePair {
public:
    HalfSpacePair(const Part<D>& part_a, const RigidPath<D>& path_a, const Part<D>& part_b, const RigidPath<D>& path_b)
        : a_is_half_space_(part_a.is_half_space()),
          tolerance(tolerance_of(part_a, part_b)),
          a(set_or_border_point(part_a), path_a, a_is_half_space_ ? never : 0.02 * tolerance),
          b(set_or_border_point(part_b), path_b, a_is_half_space_ ? 0.02 * tolerance : never),
          depth_error(depth_error_of((a_is_half_space_ ? part_b : part_a).convex())),
          rotation_((a_is_half_space_ ? path_a : path_b).angular_velocity),
          normal_(rotation_.of((a_is_half_space_ ? path_a : path_b)
                                   .start.vector((a_is_half_space_ ? part_a : part_b).half_space().normal))) {}

    SignedDistance<D> distance(double time) {
        go_to(time);
        return part_distance<D>(here_a(), here_b());
    }
    bool has_unique_normal(const SignedDistance<D>&) const { return true; }
    Manifold<D> contact_points(const SignedDistance<D>&) const {
        return manifold_with_plane((a_is_half_space_ ? b : a).here(), half_space_.normal, half_space_.offset,
                                   tolerance);
    }
    double separated_to(double from, double until, double level, double step_tolerance, const SignedDistance<D>& now,
                        bool) {
        SeparationFunction<D> gap(a, b, now.normal, (a_is_half_space_ ? a : b).path().angular_velocity, from);
        return separated_until(gap, from, until, gap.at_first(now.normal, now.distance, now.on_a, now.on_b()), level,
                               step_tolerance)
            .time;
    }
    void go_to(double time) {
        a.go_to(time);
        b.go_to(time);
        half_space_.normal = normal_.at(sin_cos(rotation_.rate * time));
        half_space_.offset = dot(half_space_.normal, (a_is_half_space_ ? a : b).here().place.offset);
    }
    Part<D> here_a() const { return a_is_half_space_ ? Part<D>(half_space_) : Part<D>(a.here()); }
    Part<D> here_b() const { return a_is_half_space_ ? Part<D>(b.here()) : Part<D>(half_space_); }
    double reach_a() const { return a_is_half_space_ ? std::numeric_limits<double>::infinity() : a.reach(); }
    double reach_b() const { return a_is_half_space_ ? b.reach() : std::numeric_limits<double>::infinity(); }
    Feature feature_on_b(const SignedDistance<D>& distance) const {
        Feature result;
        name_feature(here_b(), distance.corners.b, distance.corners.count, -distance.normal, 0, result);
        return result;
    }

private:
    static constexpr double never = -1;

    static double tolerance_of(const Part<D>& part_a, const Part<D>& part_b) {
        const double radius = radius_of((part_a.is_half_space() ? part_b : part_a).convex());
        return detail::tolerance_of(radius, radius);
    }
    static Convex<D> set_or_border_point(const Part<D>& part) {
        if (part.is_convex()) return part.convex();
        Convex<D> result;
        result.place.offset = part.half_space().normal * part.half_space().offset;
        return result;
    }

    bool a_is_half_space_;

public:
    double tolerance;
    RotatingSet<D> a, b;
    double depth_error;  ///< by how much a depth may exceed the least depth

private:
    RotationAxis<D> rotation_;
    RotatingVector<D> normal_;
    HalfSpaceView<D> half_space_;
};

/// Whether two parts that touch, or are about to, go further in at once.
template <int D, class Pair>
class DeepeningTest {
public:
    DeepeningTest(Pair& pair, double time, const SignedDistance<D>& now) : pair_(pair), time_(time), now_(now) {}

    /// Tests the closest points first, then all points of the contact manifold: where a face tilts, another point goes
    /// in.
    bool deepens() const {
        if (deepens_at(speed_at(now_.on_a))) return true;
        const Manifold<D> contacts = pair_.contact_points(now_);
        double max_speed = 0;
        for (std::size_t i = 0; i < contacts.count; ++i)
            if (contacts.points[i].depth >= -now_.distance - pair_.tolerance)
                max_speed = std::max(max_speed, speed_at(contacts.points[i].position));
        return deepens_at(max_speed);
    }

private:
    /// The speed of approach along the normal at a point.
    double speed_at(const DVec<D>& place) const {
        return dot(now_.normal, pair_.a.path().velocity(time_, place) - pair_.b.path().velocity(time_, place));
    }

    /// A motion that would move less than rounding over the whole interval doesn't count. A corner against a corner has
    /// many normals, and motion against one of them proves nothing; neither does the edge of a crate that slides to the
    /// next board of its floor. So it tests whether they are deeper one tolerance later.
    bool deepens_at(double speed) const {
        if (!(speed > std::max(0.5 * pair_.tolerance, 1e-6 * (pair_.a.travel() + pair_.b.travel())))) return false;
        if (pair_.has_unique_normal(now_)) return true;
        if (pair_.distance(time_ + pair_.tolerance / speed).distance < now_.distance - 0.5 * pair_.tolerance)
            return true;
        pair_.go_to(time_);
        return false;
    }

    Pair& pair_;
    double time_;
    const SignedDistance<D>& now_;
};

/// Advances from one proven time to the next until the impact. The levels leave a margin to the next one for rounding,
/// in tolerances. Apart, the gap is followed down to 0.2 to 0.4, and they touch at 0.5. Touching parts that don't go
/// further in may sink by at most 0.5, and have gone in at 0.3 below touching or their start. Axes that prove that deep
/// parts sink no deeper don't show when these come apart. So they are followed from both sides: certainly not apart by
/// 1, and apart at 0.5.
template <int D, class Pair>
class RotatingSweep {
public:
    RotatingSweep(Pair& pair, const RotatingSweepLimits& limits)
        : pair_(pair), limits_(limits), tolerance_(pair.tolerance) {}

    bool run(RotatingImpact<D>& impact) {
        time_ = limits_.from;
        now_ = pair_.distance(time_);
        // Parts that have been sliding are followed from the start.
        if (time_ > 0 && now_.distance <= tolerance_) now_ = pair_.distance(time_ = 0);
        const double from = time_;
        bool started_inside = now_.distance < -tolerance_;
        for (int step = 0;; ++step) {
            if (has_impact() || step >= limits_.max_iterations) break;
            time_ = free_until(step >= fast_iterations);
            if (time_ >= limits_.until || time_ > limits_.reach) return false;
            now_ = pair_.distance(time_);
        }
        const Feature feature = pair_.feature_on_b(now_);
        if (from > 0) started_inside = pair_.distance(0).distance < -tolerance_;
        impact = {time_, now_.on_b(), now_.normal, started_inside, feature};
        return true;
    }

private:
    /// Whether the state at the current time is an impact.
    bool has_impact() {
        bool deepens = false;
        if (is_apart_ && now_.distance <= 0.5 * tolerance_) {
            deepens = DeepeningTest<D, Pair>(pair_, time_, now_).deepens();
            is_apart_ = false;
            depth_limit_ = std::min(now_.distance, 0.0);
            if (is_overlapping()) depth_limit_ -= pair_.depth_error;
        } else if (!is_apart_) {
            deepens = now_.distance <= depth_limit_ - 0.3 * tolerance_;
        }
        if (deepens) {
            pair_.go_to(time_);
            if (touch_at_fronts(pair_.here_a(), pair_.here_b(), now_.normal)) return true;
            // A part may enter by a back face freely, and is hit after it has come out.
            depth_limit_ = -std::numeric_limits<double>::infinity();
            no_deeper_until_ = limits_.until;
        }
        is_apart_ = is_apart_ || now_.distance > (is_overlapping() ? 0.5 : 1) * tolerance_;
        return false;
    }

    double free_until(bool try_all_axes) {
        if (is_apart_) {
            no_deeper_until_ = 0;
            return pair_.separated_to(time_, limits_.until, 0.2 * tolerance_, 0.2 * tolerance_, now_, try_all_axes);
        }
        if (time_ >= no_deeper_until_)
            no_deeper_until_ = pair_.separated_to(time_, limits_.until, depth_limit_ - 0.5 * tolerance_,
                                                  0.15 * tolerance_, now_, true);
        if (!is_overlapping()) return no_deeper_until_;
        return ContactInterval<D, Pair>(pair_).until({time_, no_deeper_until_}, now_.distance);
    }

    /// Whether they may overlap by more than the tolerance.
    bool is_overlapping() const { return depth_limit_ < -tolerance_; }

    Pair& pair_;
    const RotatingSweepLimits& limits_;
    const double tolerance_;
    double time_ = 0;
    SignedDistance<D> now_;
    bool is_apart_ = true;
    double depth_limit_ = 0;      ///< while they aren't apart: deeper than this is an impact
    double no_deeper_until_ = 0;  ///< while they aren't apart
};

}  // namespace

template <int D>
bool time_of_impact(const AnyPart<D>& a, const RigidPath<D>& path_a, const AnyPart<D>& b, const RigidPath<D>& path_b,
                    const RotatingSweepLimits& limits, const SearchOptions<D>& options, RotatingImpact<D>& impact) {
    if (are_convex<D>(a, b)) {
        ConvexPair<D> pair(a.convex(), path_a, b.convex(), path_b, options);
        return RotatingSweep<D, ConvexPair<D>>(pair, limits).run(impact);
    }
    HalfSpacePair<D> pair(a, path_a, b, path_b);
    return RotatingSweep<D, HalfSpacePair<D>>(pair, limits).run(impact);
}

#define ABUT_INSTANTIATE(D)                                                                                      \
    template bool time_of_impact(const AnyPart<D>&, const RigidPath<D>&, const AnyPart<D>&, const RigidPath<D>&, \
                                 const RotatingSweepLimits&, const SearchOptions<D>&, RotatingImpact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
