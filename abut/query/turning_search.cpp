#include <abut/convex/manifold.hpp>
#include <abut/convex/turning_gap.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/turning_search.hpp>

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

/// DESIGN's margin of doubt, with the least that rounding can be.
double margin_of(double size_a, double size_b) {
    return 1e-5 * std::min(size_a, size_b) + 16 * 0x1p-24 * std::max(size_a, size_b);
}

template <int D>
class ConvexPair {
public:
    ConvexPair(const Convex<D>& set_a, const RigidPath<D>& path_a, const Convex<D>& set_b, const RigidPath<D>& path_b,
               const SearchOptions<D>& options)
        : margin(margin_of(radius_of(set_a), radius_of(set_b))),
          a(set_a, path_a, 0.02 * margin),
          b(set_b, path_b, 0.02 * margin),
          options_(options) {
        if (options_.cache == nullptr) options_.cache = &cache_;
    }

    SignedDistance<D> distance(double time) {
        a.go_to(time);
        b.go_to(time);
        return part_distance(a.here(), b.here(), options_);
    }
    Manifold<D> meeting_points(const SignedDistance<D>& distance) const {
        return manifold(a.here(), b.here(), distance, margin);
    }

    /// How far the gap proves them apart, along the axis across the features that are nearest. A thorough search, for
    /// what touches and where that leads nowhere, tries axes that stand still or turn with one of the two as well.
    double open_to(double from, double until, double level, double slack, const SignedDistance<D>& now, bool thorough) {
        const Spin<D> still{};
        const Spin<D> across = spin_across(a, b, now.normal, now.corners);
        double time = follow(across, from, until, level, slack, now);
        if (time >= until || !thorough) return time;
        for (const Spin<D>& spin : {still, a.path().spin, b.path().spin})
            if (spin != across) time = std::max(time, follow(spin, from, until, level, slack, now));
        return time;
    }

    Feature feature_on_b(const SignedDistance<D>& distance) const {
        Feature result;
        name_feature(b.here(), distance.corners.b, distance.corners.count, -distance.normal, 0, result);
        return result;
    }

    double margin;
    TurningSet<D> a, b;

private:
    double follow(const Spin<D>& spin, double from, double until, double level, double slack,
                  const SignedDistance<D>& now) {
        TurningGap<D> gap(a, b, now.normal, spin, from);
        return open_until(gap, from, until, gap.at_first(now.normal, now.distance, now.on_a, now.on_b()), level, slack)
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
    SolidPair(const Solid<D>& solid, const RigidPath<D>& path_of_solid, const Convex<D>& convex,
              const RigidPath<D>& path_of_set)
        : margin(margin_of(radius_of(convex), radius_of(convex))),
          a(first_is_solid ? foot_of(solid) : convex, first_is_solid ? path_of_solid : path_of_set,
            first_is_solid ? never : 0.02 * margin),
          b(first_is_solid ? convex : foot_of(solid), first_is_solid ? path_of_set : path_of_solid,
            first_is_solid ? 0.02 * margin : never),
          turning_(path_of_solid.spin),
          normal_(turning_.of(path_of_solid.start.vector(solid.normal))) {}

    SignedDistance<D> distance(double time) {
        a.go_to(time);
        b.go_to(time);
        solid_.normal = normal_.at(sin_cos(turning_.rate * time));
        solid_.offset = dot(solid_.normal, foot().place.offset);
        SignedDistance<D> result = part_distance(set(), solid_);
        if (first_is_solid) turn_round(result);
        return result;
    }
    Manifold<D> meeting_points(const SignedDistance<D>&) const {
        return manifold_with_plane(set(), solid_.normal, solid_.offset, margin);
    }
    double open_to(double from, double until, double level, double slack, const SignedDistance<D>& now, bool) {
        TurningGap<D> gap(a, b, now.normal, first_is_solid ? a.path().spin : b.path().spin, from);
        return open_until(gap, from, until, gap.at_first(now.normal, now.distance, now.on_a, now.on_b()), level, slack)
            .time;
    }
    Feature feature_on_b(const SignedDistance<D>& distance) const {
        Feature result;
        if (first_is_solid)
            name_feature(set(), distance.corners.b, distance.corners.count, -distance.normal, 0, result);
        return result;
    }

    double margin;
    TurningSet<D> a, b;

private:
    static constexpr double never = -1;

    static Convex<D> foot_of(const Solid<D>& solid) {
        Convex<D> result;
        result.place.offset = solid.normal * solid.offset;
        return result;
    }
    const Convex<D>& foot() const { return first_is_solid ? a.here() : b.here(); }
    const Convex<D>& set() const { return first_is_solid ? b.here() : a.here(); }

    TurningAxis<D> turning_;
    TurningVector<D> normal_;
    Solid<D> solid_;
};

/// How fast the two come nearer at first along the way out, where they meet; zero or less where they don't.
template <class Pair, int D>
double speed_inwards(const Pair& pair, const SignedDistance<D>& distance) {
    const RigidPath<D>&path_a = pair.a.path(), &path_b = pair.b.path();
    const Manifold<D> meeting = pair.meeting_points(distance);
    const auto speed_at = [&](const DVec<D>& place) {
        return dot(distance.normal, path_a.velocity(0, place) - path_b.velocity(0, place));
    };
    if (meeting.count == 0) return speed_at(distance.on_a);
    double most = 0;
    for (std::size_t i = 0; i < meeting.count; ++i)
        if (meeting.points[i].depth >= -distance.distance - pair.margin)
            most = std::max(most, speed_at(meeting.points[i].position));
    return most;
}

/// Whether the motion goes further in at once. What would not get farther than rounding in the whole of it does not
/// count. A corner at a corner has many ways out, and of one that it moves against nothing follows: so it is looked at
/// whether a margin later they are deeper indeed.
template <class Pair, int D>
bool goes_in(Pair& pair, const SignedDistance<D>& distance) {
    const double speed = speed_inwards(pair, distance);
    if (!(speed > std::max(0.5 * pair.margin, 1e-6 * (pair.a.travel() + pair.b.travel())))) return false;
    const double soon = std::min(1.0, pair.margin / speed);
    const bool deeper = pair.distance(soon).distance < distance.distance - 0.5 * soon * speed;
    pair.a.go_to(0);
    pair.b.go_to(0);
    return deeper;
}

/// From time to time that is proven free, until they meet. The levels are chosen so that each comes with some way to go
/// to the next, whatever rounding does: apart, they are followed down to a gap of 0.2 to 0.4 margins, and meet at 0.5;
/// what touches from the start may sink in by 0.5 of a margin at the most, and has at 0.3.
template <int D, class Pair>
bool search(Pair& pair, const TurningLimits& limits, Meeting<D>& meeting) {
    const double margin = pair.margin;
    SignedDistance<D> now = pair.distance(0);
    const bool started_inside = now.distance < -margin;
    bool apart = now.distance > 0.5 * margin, meets = !apart && goes_in(pair, now);
    double time = 0, highest = now.distance;
    for (int step = 0; !meets; ++step) {
        const double level = apart ? 0.2 * margin : highest - 0.5 * margin;
        const double slack = apart ? 0.2 * margin : 0.15 * margin;
        time = pair.open_to(time, limits.until, level, slack, now, !apart || step >= quick_steps);
        if (time >= limits.until) return false;
        now = pair.distance(time);
        meets = step + 1 >= limits.most_steps || now.distance <= (apart ? 0.5 * margin : highest - 0.3 * margin);
        highest = std::max(highest, now.distance);
        apart = apart || highest > margin;
    }
    meeting = {time, now.on_b(), now.normal, started_inside, pair.feature_on_b(now)};
    return true;
}

}  // namespace

template <int D>
bool first_meeting(const Convex<D>& a, const RigidPath<D>& path_a, const Convex<D>& b, const RigidPath<D>& path_b,
                   const TurningLimits& limits, const SearchOptions<D>& options, Meeting<D>& meeting) {
    ConvexPair<D> pair(a, path_a, b, path_b, options);
    return search(pair, limits, meeting);
}

template <int D>
bool first_meeting(const Convex<D>& a, const RigidPath<D>& path_a, const Solid<D>& b, const RigidPath<D>& path_b,
                   const TurningLimits& limits, const SearchOptions<D>&, Meeting<D>& meeting) {
    SolidPair<D, false> pair(b, path_b, a, path_a);
    return search(pair, limits, meeting);
}

template <int D>
bool first_meeting(const Solid<D>& a, const RigidPath<D>& path_a, const Convex<D>& b, const RigidPath<D>& path_b,
                   const TurningLimits& limits, const SearchOptions<D>&, Meeting<D>& meeting) {
    SolidPair<D, true> pair(a, path_a, b, path_b);
    return search(pair, limits, meeting);
}

#define ABUT_INSTANTIATE(D)                                                                                   \
    template bool first_meeting(const Convex<D>&, const RigidPath<D>&, const Convex<D>&, const RigidPath<D>&, \
                                const TurningLimits&, const SearchOptions<D>&, Meeting<D>&);                  \
    template bool first_meeting(const Convex<D>&, const RigidPath<D>&, const Solid<D>&, const RigidPath<D>&,  \
                                const TurningLimits&, const SearchOptions<D>&, Meeting<D>&);                  \
    template bool first_meeting(const Solid<D>&, const RigidPath<D>&, const Convex<D>&, const RigidPath<D>&,  \
                                const TurningLimits&, const SearchOptions<D>&, Meeting<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
