#include <abut/convex/pairs/round3.hpp>
#include <abut/convex/pairs/round3_simd-inl.h>

namespace abut::detail {
namespace {

double part_of(double along, double whole) {
    return whole > 0 ? std::clamp(along / whole, 0.0, 1.0) : 0.0;
}

/// The ends of a segment that span a point on it.
struct Ends {
    std::uint32_t first, last;
};
Ends ends_at(double part) {
    return {part >= 1 ? 1u : 0u, part > 0 ? 1u : 0u};
}

/// The unit normal of both, if it is reliable; else zero.
DVec<3> across_both(const DVec<3>& u, const DVec<3>& v) {
    const DVec<3> across = cross(u, v);
    const double square = length_squared(across);
    return square > min_round3_gap * length_squared(u) * length_squared(v) ? across / std::sqrt(square) : DVec<3>(0.0);
}
DVec<2> across_both(const DVec<2>&, const DVec<2>&) {
    return DVec<2>(0.0);
}

void set_distance(const SegmentClosest& closest, SignedDistance<3>& result) {
    result.distance = closest.distance[0];
    result.normal = lanes::vector(closest.normal);
    result.on_a = lanes::vector(closest.on_a);
    result.corners.a[0] = closest.place_a == 2 ? 1 : 0;
    result.corners.a[1] = closest.place_a == 0 ? 0 : 1;
    result.corners.b[0] = closest.place_b == 2 ? 1 : 0;
    result.corners.b[1] = closest.place_b == 0 ? 0 : 1;
    result.corners.count = 2;
}

}  // namespace

template <int D>
SegmentParameters closest_end_parameters(const DVec<D>& u, const DVec<D>& v, const DVec<D>& w) {
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const SegmentParameters all[] = {
        {0, part_of(vw, vv)}, {1, part_of(vw + uv, vv)}, {part_of(-uw, uu), 0}, {part_of(uv - uw, uu), 1}};
    SegmentParameters best = all[0];
    double minimum = std::numeric_limits<double>::infinity();
    for (const SegmentParameters& places : all) {
        const double distance = length_squared(w + u * places.on_a - v * places.on_b);
        if (distance >= minimum) continue;
        minimum = distance;
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
    if (!(gap > min_round3_gap * scale)) {
        // Once more, relative to a nearer point.
        if (ends.first != ends.last) between -= u * (dot(between, u) / uu);
        gap = length(between);
        on_segment = w - between;
    }
    // For a point on the segment each direction orthogonal to it is a normal, and at an end the direction beyond it.
    const bool outside = gap > round3_tolerance * scale;
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
        const SegmentPair pair{lanes::double3(core_corner(a, 0)), lanes::double3(core_corner(a, 1)),
                               lanes::double3(core_corner(b, 0)), lanes::double3(core_corner(b, 1)),
                               lanes::double2(a.radius),          lanes::double2(b.radius)};
        SegmentClosest closest;
        if (closest_on_segments(pair, closest)) {
            set_distance(closest, result);
            return true;
        }
    }
    // Relative to an end of A.
    const DVec<D> origin = core_corner(a, 0), from = core_corner(b, 0) - origin;
    const DVec<D> u = core_corner(a, 1) - origin, to = core_corner(b, 1) - origin, v = to - from;
    const SegmentParameters places = closest_parameters(u, v, -from);
    const DVec<D> on_a = u * places.on_a, between = from + v * places.on_b - on_a;
    const double gap = length(between), scale = std::max({largest(u), largest(from), largest(to)});
    DVec<D> normal = between;
    if (gap > min_round3_gap * scale) {
        normal = between * (1 / gap);
    } else {
        // The segments cross.
        normal = across_both(u, v);
        if (normal == DVec<D>(0.0)) return false;
        if (dot(normal, between) < 0) normal = -normal;
    }
    const double proven = std::min(dot(normal, from), dot(normal, to)) - std::max(0.0, dot(normal, u));
    if (!(gap - proven <= round3_tolerance * scale)) return false;

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

template SegmentParameters closest_end_parameters(const DVec<2>&, const DVec<2>&, const DVec<2>&);
template SegmentParameters closest_end_parameters(const DVec<3>&, const DVec<3>&, const DVec<3>&);
template bool segment_segment(const Convex<2>&, const Convex<2>&, SignedDistance<2>&);
template bool segment_segment(const Convex<3>&, const Convex<3>&, SignedDistance<3>&);

}  // namespace abut::detail
