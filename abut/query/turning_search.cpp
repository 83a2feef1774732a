#include <abut/convex/manifold/manifold.hpp>
#include <abut/convex/toi/separation_function.hpp>
#include <abut/convex/tolerance.hpp>
#include <abut/query/one_sided.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/turning_search.hpp>
#include <abut/query/turning_together.hpp>

namespace abut {
namespace {

/// From so many steps on each tries all it can.
constexpr int quick_steps = 4;

/// The bounding radius, for less than asking for all extents where the core tells it.
template <int D>
double radius_of(const Convex<D>& set) {
    if (is_plain_box(set)) return length(DVec<D>(set.own[0])) * set.scale + set.radius;
    return size(set);
}

/// With the least that rounding can be: of coordinates as large as the larger of the two.
double margin_of(double size_a, double size_b) {
    return tolerance_for(std::min(size_a, size_b), std::max(size_a, size_b));
}

/// By how much a depth that is told may be above the least.
template <int D>
double depth_doubt(const Convex<D>& set) {
    const bool exact = set.inner_radius == 0 && (set.core == Core::points || set.core == Core::box);
    return exact ? 0 : 1e-3 * radius_of(set);
}

template <int D>
class ConvexPair {
public:
    ConvexPair(const Convex<D>& set_a, const RigidPath<D>& path_a, const Convex<D>& set_b, const RigidPath<D>& path_b,
               const SearchOptions<D>& options)
        : margin(margin_of(radius_of(set_a), radius_of(set_b))),
          a(set_a, path_a, 0.02 * margin),
          b(set_b, path_b, 0.02 * margin),
          doubt(depth_doubt(set_a) + depth_doubt(set_b)),
          options_(options) {
        if (options_.cache == nullptr) options_.cache = &cache_;
    }

    SignedDistance<D> distance(double time) {
        go_to(time);
        return part_distance(a.here(), b.here(), options_);
    }
    Manifold<D> meeting_points(const SignedDistance<D>& distance) const {
        return manifold(a.here(), b.here(), distance, margin);
    }

    /// How far the gap proves them apart, along the axis across the features that are nearest. A thorough search, for
    /// what touches and where that leads nowhere, tries axes that stand still or turn with one of the two as well.
    double open_to(double from, double until, double level, double slack, const SignedDistance<D>& now, bool thorough) {
        const AngularVelocity<D> still{};
        const AngularVelocity<D> across = axis_angular_velocity(a, b, now.normal, now.corners);
        double time = follow(across, from, until, level, slack, now);
        if (time >= until || !thorough) return time;
        for (const AngularVelocity<D>& angular_velocity : {still, a.path().angular_velocity, b.path().angular_velocity})
            if (angular_velocity != across)
                time = std::max(time, follow(angular_velocity, from, until, level, slack, now));
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

    /// Whether it is clear at first sight that one direction alone leads out where they are nearest: of what is round,
    /// and in the plane of what is met amid a side.
    bool has_one_way_out(const SignedDistance<D>& now) const {
        if (a.here().radius + b.here().radius > far * margin) return true;
        return D == 2 && (is_amid_side(a.here(), now.corners, now.corners.a, now.on_a) ||
                          is_amid_side(b.here(), now.corners, now.corners.b, now.on_b()));
    }

    Feature feature_on_b(const SignedDistance<D>& distance) const {
        Feature result;
        name_feature(b.here(), distance.corners.b, distance.corners.count, -distance.normal, 0, result);
        return result;
    }

    double margin;
    RotatingSet<D> a, b;
    double doubt;  ///< by how much a depth may be above the least

private:
    static constexpr double far = 10;  ///< from an end, in margins

    /// On a core of corners, of which a place is made of some: far from each of them.
    bool is_amid_side(const Convex<D>& set, const ClosestCorners<D>& meeting, const CornerIndices<D>& corners,
                      const DVec<D>& place) const {
        if (corners[0] == corners[1] || meeting.count < 2) return false;
        bool result = true;
        for (std::size_t i = 0; i < meeting.count; ++i)
            result =
                result && has_corner(set, corners[i]) &&
                length_squared(set.place.point(local_corner(set, corners[i])) - place) > far * far * margin * margin;
        return result;
    }

    double follow(const AngularVelocity<D>& angular_velocity, double from, double until, double level, double slack,
                  const SignedDistance<D>& now) {
        SeparationFunction<D> gap(a, b, now.normal, angular_velocity, from);
        return separated_until(gap, from, until, gap.at_first(now.normal, now.distance, now.on_a, now.on_b()), level,
                               slack)
            .time;
    }

    SearchOptions<D> options_;
    Cache cache_;
};

/// A set and a half-space, whose border is the axis' only choice and tells the distance itself. A point of the border
/// stands for it.
template <int D, bool first_is_solid>
class SolidPair {
public:
    SolidPair(const HalfSpaceView<D>& solid, const RigidPath<D>& path_of_solid, const Convex<D>& convex,
              const RigidPath<D>& path_of_set)
        : margin(margin_of(radius_of(convex), radius_of(convex))),
          a(first_is_solid ? foot_of(solid) : convex, first_is_solid ? path_of_solid : path_of_set,
            first_is_solid ? never : 0.02 * margin),
          b(first_is_solid ? convex : foot_of(solid), first_is_solid ? path_of_set : path_of_solid,
            first_is_solid ? 0.02 * margin : never),
          doubt(depth_doubt(convex)),
          turning_(path_of_solid.angular_velocity),
          normal_(turning_.of(path_of_solid.start.vector(solid.normal))) {}

    SignedDistance<D> distance(double time) {
        go_to(time);
        SignedDistance<D> result = part_distance(set(), solid_);
        if (first_is_solid) swap_roles(result);
        return result;
    }
    bool has_one_way_out(const SignedDistance<D>&) const { return true; }
    Manifold<D> meeting_points(const SignedDistance<D>&) const {
        return manifold_with_plane(set(), solid_.normal, solid_.offset, margin);
    }
    double open_to(double from, double until, double level, double slack, const SignedDistance<D>& now, bool) {
        SeparationFunction<D> gap(a, b, now.normal,
                                  first_is_solid ? a.path().angular_velocity : b.path().angular_velocity, from);
        return separated_until(gap, from, until, gap.at_first(now.normal, now.distance, now.on_a, now.on_b()), level,
                               slack)
            .time;
    }
    void go_to(double time) {
        a.go_to(time);
        b.go_to(time);
        solid_.normal = normal_.at(sin_cos(turning_.rate * time));
        solid_.offset = dot(solid_.normal, foot().place.offset);
    }
    const auto& here_a() const {
        if constexpr (first_is_solid)
            return solid_;
        else
            return a.here();
    }
    const auto& here_b() const {
        if constexpr (first_is_solid)
            return b.here();
        else
            return solid_;
    }
    double reach_a() const { return first_is_solid ? std::numeric_limits<double>::infinity() : a.reach(); }
    double reach_b() const { return first_is_solid ? b.reach() : std::numeric_limits<double>::infinity(); }
    Feature feature_on_b(const SignedDistance<D>& distance) const {
        Feature result;
        if (first_is_solid)
            name_feature(set(), distance.corners.b, distance.corners.count, -distance.normal, 0, result);
        return result;
    }

    double margin;
    RotatingSet<D> a, b;
    double doubt;  ///< by how much a depth may be above the least

private:
    static constexpr double never = -1;

    static Convex<D> foot_of(const HalfSpaceView<D>& solid) {
        Convex<D> result;
        result.place.offset = solid.normal * solid.offset;
        return result;
    }
    const Convex<D>& foot() const { return first_is_solid ? a.here() : b.here(); }
    const Convex<D>& set() const { return first_is_solid ? b.here() : a.here(); }

    RotationAxis<D> turning_;
    RotatingVector<D> normal_;
    HalfSpaceView<D> solid_;
};

/// Whether two that touch, or are about to, go further in at once.
template <int D, class Pair>
class Entry {
public:
    Entry(Pair& pair, double time, const SignedDistance<D>& now) : pair_(pair), time_(time), now_(now) {}

    /// Judged where they are nearest, and if not there, then wherever they meet: of a face that tilts another place
    /// goes in.
    bool goes_in() const {
        if (deepens_at(speed_at(now_.on_a))) return true;
        const Manifold<D> meeting = pair_.meeting_points(now_);
        double most = 0;
        for (std::size_t i = 0; i < meeting.count; ++i)
            if (meeting.points[i].depth >= -now_.distance - pair_.margin)
                most = std::max(most, speed_at(meeting.points[i].position));
        return deepens_at(most);
    }

private:
    /// How fast the two come nearer there along the way out.
    double speed_at(const DVec<D>& place) const {
        return dot(now_.normal, pair_.a.path().velocity(time_, place) - pair_.b.path().velocity(time_, place));
    }

    /// What would not get farther than rounding in the whole of the motion does not count. A corner at a corner has
    /// many ways out, and of one that it moves against nothing follows; nor does anything of a crate's edge that comes
    /// to the next board of the floor it slides on. So it is looked at whether a margin later they are deeper indeed.
    bool deepens_at(double speed) const {
        if (!(speed > std::max(0.5 * pair_.margin, 1e-6 * (pair_.a.travel() + pair_.b.travel())))) return false;
        if (pair_.has_one_way_out(now_)) return true;
        if (pair_.distance(time_ + pair_.margin / speed).distance < now_.distance - 0.5 * pair_.margin) return true;
        pair_.go_to(time_);
        return false;
    }

    Pair& pair_;
    double time_;
    const SignedDistance<D>& now_;
};

/// From time to time that is proven free, until they meet. The levels are chosen so that each comes with some way to go
/// to the next, whatever rounding does: apart, they are followed down to a gap of 0.2 to 0.4 margins, and touch at 0.5;
/// what touches and doesn't go further in may sink by 0.5 of a margin at the most, and has at 0.3, below touching or
/// where it began. What is deeper than the margin isn't seen to come apart in between by the axes that prove that it
/// sinks no deeper, so it is followed from both sides: surely not apart by a margin, and apart at half of one.
template <int D, class Pair>
class Search {
public:
    Search(Pair& pair, const TurningLimits& limits) : pair_(pair), limits_(limits), margin_(pair.margin) {}

    bool run(Meeting<D>& meeting) {
        time_ = limits_.from;
        now_ = pair_.distance(time_);
        // What has been sliding is looked at from where it began to.
        if (time_ > 0 && now_.distance <= margin_) now_ = pair_.distance(time_ = 0);
        const double from = time_;
        bool started_inside = now_.distance < -margin_;
        for (int step = 0;; ++step) {
            if (has_met() || step >= limits_.most_steps) break;
            time_ = free_until(step >= quick_steps);
            if (time_ >= limits_.until || time_ > limits_.reach) return false;
            now_ = pair_.distance(time_);
        }
        const Feature feature = pair_.feature_on_b(now_);
        if (from > 0) started_inside = pair_.distance(0).distance < -margin_;
        meeting = {time_, now_.on_b(), now_.normal, started_inside, feature};
        return true;
    }

private:
    /// Looks at them as they are now.
    bool has_met() {
        bool goes_in = false;
        if (apart_ && now_.distance <= 0.5 * margin_) {
            goes_in = Entry<D, Pair>(pair_, time_, now_).goes_in();
            apart_ = false;
            floor_ = std::min(now_.distance, 0.0);
            if (is_deep()) floor_ -= pair_.doubt;
        } else if (!apart_) {
            goes_in = now_.distance <= floor_ - 0.3 * margin_;
        }
        if (goes_in) {
            pair_.go_to(time_);
            if (meet_at_fronts(pair_.here_a(), pair_.here_b(), now_.normal)) return true;
            // By a back it goes in as deep as it likes, and is met when it has come out.
            floor_ = -std::numeric_limits<double>::infinity();
            no_deeper_until_ = limits_.until;
        }
        apart_ = apart_ || now_.distance > (is_deep() ? 0.5 : 1) * margin_;
        return false;
    }

    double free_until(bool thorough) {
        if (apart_) {
            no_deeper_until_ = 0;
            return pair_.open_to(time_, limits_.until, 0.2 * margin_, 0.2 * margin_, now_, thorough);
        }
        if (time_ >= no_deeper_until_)
            no_deeper_until_ = pair_.open_to(time_, limits_.until, floor_ - 0.5 * margin_, 0.15 * margin_, now_, true);
        if (!is_deep()) return no_deeper_until_;
        return Together<D, Pair>(pair_).until({time_, no_deeper_until_}, now_.distance);
    }

    /// Whether they may be in one another by more than the margin.
    bool is_deep() const { return floor_ < -margin_; }

    Pair& pair_;
    const TurningLimits& limits_;
    const double margin_;
    double time_ = 0;
    SignedDistance<D> now_;
    bool apart_ = true;
    double floor_ = 0;            ///< while they aren't apart: what is deeper than that has gone in
    double no_deeper_until_ = 0;  ///< while they aren't apart
};

}  // namespace

template <int D>
bool first_meeting(const Convex<D>& a, const RigidPath<D>& path_a, const Convex<D>& b, const RigidPath<D>& path_b,
                   const TurningLimits& limits, const SearchOptions<D>& options, Meeting<D>& meeting) {
    ConvexPair<D> pair(a, path_a, b, path_b, options);
    return Search<D, decltype(pair)>(pair, limits).run(meeting);
}

template <int D>
bool first_meeting(const Convex<D>& a, const RigidPath<D>& path_a, const HalfSpaceView<D>& b,
                   const RigidPath<D>& path_b, const TurningLimits& limits, const SearchOptions<D>&,
                   Meeting<D>& meeting) {
    SolidPair<D, false> pair(b, path_b, a, path_a);
    return Search<D, decltype(pair)>(pair, limits).run(meeting);
}

template <int D>
bool first_meeting(const HalfSpaceView<D>& a, const RigidPath<D>& path_a, const Convex<D>& b,
                   const RigidPath<D>& path_b, const TurningLimits& limits, const SearchOptions<D>&,
                   Meeting<D>& meeting) {
    SolidPair<D, true> pair(a, path_a, b, path_b);
    return Search<D, decltype(pair)>(pair, limits).run(meeting);
}

#define ABUT_INSTANTIATE(D)                                                                                          \
    template bool first_meeting(const Convex<D>&, const RigidPath<D>&, const Convex<D>&, const RigidPath<D>&,        \
                                const TurningLimits&, const SearchOptions<D>&, Meeting<D>&);                         \
    template bool first_meeting(const Convex<D>&, const RigidPath<D>&, const HalfSpaceView<D>&, const RigidPath<D>&, \
                                const TurningLimits&, const SearchOptions<D>&, Meeting<D>&);                         \
    template bool first_meeting(const HalfSpaceView<D>&, const RigidPath<D>&, const Convex<D>&, const RigidPath<D>&, \
                                const TurningLimits&, const SearchOptions<D>&, Meeting<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
