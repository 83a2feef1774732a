#include <abut/convex/round_lanes-inl.h>
#include <abut/convex/round_pairs.hpp>

namespace abut {
namespace {

/// What is nearer than this, in parts of the largest coordinate, has a direction that may be rounding.
constexpr double near = 1e-6;
/// By so much, in the same parts, may a proof fall short of what it proves.
constexpr double doubt = 1e-9;
double part_of(double along, double whole) {
    return whole > 0 ? std::clamp(along / whole, 0.0, 1.0) : 0.0;
}

/// Of the corners of a segment, those that a place on it is made of.
struct Ends {
    std::uint32_t first, last;
};
Ends ends_at(double part) {
    return {part >= 1 ? 1u : 0u, part > 0 ? 1u : 0u};
}

/// At right angles to both, where that is beyond doubt; else zero.
DVec<3> across_both(const DVec<3>& u, const DVec<3>& v) {
    const DVec<3> across = cross(u, v);
    const double square = length_squared(across);
    return square > near * length_squared(u) * length_squared(v) ? across / std::sqrt(square) : DVec<3>(0.0);
}
DVec<2> across_both(const DVec<2>&, const DVec<2>&) {
    return DVec<2>(0.0);
}

void set_distance(const SegmentMeeting& meeting, SignedDistance<3>& result) {
    result.distance = meeting.distance[0];
    result.normal = lanes::vector(meeting.normal);
    result.on_a = lanes::vector(meeting.on_a);
    result.corners.a[0] = meeting.place_a == 2 ? 1 : 0;
    result.corners.a[1] = meeting.place_a == 0 ? 0 : 1;
    result.corners.b[0] = meeting.place_b == 2 ? 1 : 0;
    result.corners.b[1] = meeting.place_b == 0 ? 0 : 1;
    result.corners.count = 2;
}

}  // namespace

template <int D>
Places nearest_ends(const DVec<D>& u, const DVec<D>& v, const DVec<D>& w) {
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const Places all[] = {
        {0, part_of(vw, vv)}, {1, part_of(vw + uv, vv)}, {part_of(-uw, uu), 0}, {part_of(uv - uw, uu), 1}};
    Places best = all[0];
    double least = std::numeric_limits<double>::infinity();
    for (const Places& places : all) {
        const double distance = length_squared(w + u * places.on_a - v * places.on_b);
        if (distance >= least) continue;
        least = distance;
        best = places;
    }
    return best;
}

bool point_point(const Convex<3>& a, const Convex<3>& b, SignedDistance<3>& result) {
    distance_of_points(core_corner(a, 0), a.radius, core_corner(b, 0), b.radius, result);
    return true;
}

bool segment_point(const Convex<3>& segment, const Convex<3>& point, SignedDistance<3>& result) {
    const DVec<3> from = core_corner(segment, 0), u = core_corner(segment, 1) - from, w = core_corner(point, 0) - from;
    const double uu = dot(u, u), uw = dot(u, w);
    const double part = uw <= 0 ? 0 : uw >= uu ? 1 : uw / uu;
    const Ends ends = ends_at(part);
    DVec<3> on_segment = u * part, between = w - on_segment;
    double gap = length(between);
    const double scale = std::max(largest(u), largest(w));
    if (!(gap > near * scale)) {
        // Once more, from near by.
        if (ends.first != ends.last) between -= u * (dot(between, u) / uu);
        gap = length(between);
        on_segment = w - between;
    }
    // On the segment itself each way out is as good that is at right angles to it, or at an end beyond it.
    const bool outside = gap > doubt * scale;
    result.normal = outside                   ? between * (1 / gap)
                    : ends.first != ends.last ? perpendicular(u)
                                              : normalized(part > 0 ? u : -u);
    result.distance = gap - segment.radius - point.radius;
    result.on_a = from + on_segment + result.normal * segment.radius;
    result.corners.a[0] = ends.first;
    result.corners.a[1] = ends.last;
    result.corners.count = 2;
    return true;
}

template <int D>
bool segment_segment(const Convex<D>& a, const Convex<D>& b, SignedDistance<D>& result) {
    if constexpr (D == 3) {
        const SegmentPair pair{lanes::spatial(core_corner(a, 0)),
                               lanes::spatial(core_corner(a, 1)),
                               lanes::spatial(core_corner(b, 0)),
                               lanes::spatial(core_corner(b, 1)),
                               lanes::both(a.radius),
                               lanes::both(b.radius)};
        SegmentMeeting meeting;
        if (meet(pair, meeting)) {
            set_distance(meeting, result);
            return true;
        }
    }
    // Seen from an end of A.
    const DVec<D> origin = core_corner(a, 0), from = core_corner(b, 0) - origin;
    const DVec<D> u = core_corner(a, 1) - origin, to = core_corner(b, 1) - origin, v = to - from;
    const Places places = nearest_places(u, v, -from);
    const DVec<D> on_a = u * places.on_a, between = from + v * places.on_b - on_a;
    const double gap = length(between), scale = std::max({largest(u), largest(from), largest(to)});
    DVec<D> normal = between;
    if (gap > near * scale) {
        normal = between * (1 / gap);
    } else {
        // They cross.
        normal = across_both(u, v);
        if (normal == DVec<D>(0.0)) return false;
        if (dot(normal, between) < 0) normal = -normal;
    }
    const double proven = std::min(dot(normal, from), dot(normal, to)) - std::max(0.0, dot(normal, u));
    if (!(gap - proven <= doubt * scale)) return false;

    result.distance = gap - a.radius - b.radius;
    result.normal = normal;
    result.on_a = origin + on_a + normal * a.radius;
    const Ends of_a = ends_at(places.on_a), of_b = ends_at(places.on_b);
    result.corners.a[0] = of_a.first;
    result.corners.a[1] = of_a.last;
    result.corners.b[0] = of_b.first;
    result.corners.b[1] = of_b.last;
    result.corners.count = 2;
    return true;
}

template Places nearest_ends(const DVec<2>&, const DVec<2>&, const DVec<2>&);
template Places nearest_ends(const DVec<3>&, const DVec<3>&, const DVec<3>&);
template bool segment_segment(const Convex<2>&, const Convex<2>&, SignedDistance<2>&);
template bool segment_segment(const Convex<3>&, const Convex<3>&, SignedDistance<3>&);

}  // namespace abut
