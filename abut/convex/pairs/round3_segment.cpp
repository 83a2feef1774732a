#include <abut/convex/pairs/round3.hpp>
#include <abut/math/simd/square_root.hpp>

namespace abut::detail {
namespace {

double part_of(double along, double whole) {
    return whole > 0 ? std::clamp(along / whole, 0.0, 1.0) : 0.0;
}

/// The unit normal of both, if it is reliable; else zero.
DVec<3> across_both(const DVec<3>& u, const DVec<3>& v) {
    const DVec<3> across = cross(u, v);
    const double square = length_squared(across);
    return square > min_round3_gap * length_squared(u) * length_squared(v) ? across / square_root(square)
                                                                           : DVec<3>(0.0);
}

}  // namespace

SegmentParameters closest_end_parameters(const DVec<3>& u, const DVec<3>& v, const DVec<3>& w) {
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

bool distance_of(const PlacedSegment& segment, const PlacedBall& ball, CoresDistance& found) {
    const DVec<3> from = lanes::vector(segment.from), u = lanes::vector(segment.to) - from;
    const DVec<3> w = lanes::vector(ball.center) - from;
    const double uu = dot(u, u), uw = dot(u, w);
    const double part = uw <= 0 ? 0 : uw >= uu ? 1 : uw / uu;
    set_segment_features(lanes::double2(part, 0), found);
    DVec<3> on_segment = u * part, between = w - on_segment;
    double gap = length(between);
    const double scale = std::max(largest(u), largest(w));
    if (!(gap > min_round3_gap * scale)) {
        // Once more, relative to a nearer point.
        if (found.part_a.free != 0) between -= u * (dot(between, u) / uu);
        gap = length(between);
        on_segment = w - between;
    }
    // For a point on the segment each direction orthogonal to it is a normal, and at an end the direction beyond it.
    const bool outside = gap > round3_tolerance * scale;
    found.distance = lanes::double2(gap);
    found.normal = lanes::double3(outside                  ? between * (1 / gap)
                                  : found.part_a.free != 0 ? perpendicular(u)
                                                           : normalized(part > 0 ? u : -u));
    found.on_a = lanes::double3(from + on_segment);
    found.on_b = ball.center;
    add_balls(segment.radius, ball.radius, found);
    return true;
}

bool distance_of_any_segments(const PlacedSegment& a, const PlacedSegment& b, CoresDistance& found) {
    // Relative to an end of A.
    const DVec<3> u = lanes::vector(a.to - a.from), from = lanes::vector(b.from - a.from),
                  to = lanes::vector(b.to - a.from), v = to - from;
    const SegmentParameters places = closest_parameters(u, v, -from);
    const DVec<3> on_a = u * places.on_a, between = from + v * places.on_b - on_a;
    const double gap = length(between), scale = std::max({largest(u), largest(from), largest(to)});
    DVec<3> normal;
    if (gap > min_round3_gap * scale) {
        normal = between * (1 / gap);
    } else {
        // The segments cross.
        normal = across_both(u, v);
        if (normal == DVec<3>(0.0)) return false;
        if (dot(normal, between) < 0) normal = -normal;
    }
    const double proven = std::min(dot(normal, from), dot(normal, to)) - std::max(0.0, dot(normal, u));
    if (!(gap - proven <= round3_tolerance * scale)) return false;
    found.distance = lanes::double2(gap);
    found.normal = lanes::double3(normal);
    found.on_a = a.from + lanes::double3(on_a);
    found.on_b = found.on_a + found.normal * found.distance;
    set_segment_features(lanes::double2(places.on_a, places.on_b), found);
    add_balls(a.radius, b.radius, found);
    return true;
}

}  // namespace abut::detail
