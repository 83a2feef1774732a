#include <abut/convex/plane_pair.hpp>
#include <abut/convex/plane_point.hpp>
#include <abut/convex/polygon_manifold.hpp>

namespace abut {
namespace {

constexpr double everywhere = std::numeric_limits<double>::infinity();

PlaneAnswer distance_of_points(const Outline& a, const Outline& b, SignedDistance<2>& result) {
    const DVec<2> from = a.place.offset(), between = b.place.offset() - from;
    const double gap = length(between);
    if (!(gap > 0)) return PlaneAnswer::unknown;
    result.distance = gap - a.radius - b.radius;
    result.normal = between / gap;
    result.on_a = from + result.normal * a.radius;
    result.corners = {};
    result.corners.count = 2;
    return PlaneAnswer::within;
}

void set_distance(const PolygonPair& pair, const Meeting& meeting, SignedDistance<2>& result) {
    const Outline &a = pair.outline(0), &b = pair.outline(1), &reference = pair.outline(meeting.of);
    const Sides &sides = pair.sides(meeting.of), &other = pair.sides(1 - meeting.of);
    const bool a_is_reference = meeting.of == 0;
    const DVec<2> out = reference.place.vector(meeting.normal);
    result.distance = meeting.gap - a.radius - b.radius;
    result.normal = a_is_reference ? out : -out;
    result.on_a =
        reference.place.point(a_is_reference ? meeting.on_reference : meeting.on_other) + result.normal * a.radius;
    auto &of_reference = a_is_reference ? result.corners.a : result.corners.b,
         &of_other = a_is_reference ? result.corners.b : result.corners.a;
    for (std::size_t i = 0; i < 2; ++i) {
        of_reference[i] = sides.corner_number(meeting.reference_corners[i]);
        of_other[i] = other.corner_number(meeting.other_corners[i]);
    }
    result.corners.count = 2;
}

/// Pairs with a point that has a ball around it.
PlaneAnswer distance_of_round(const Outline& a, const Outline& b, double reach, SignedDistance<2>& result) {
    if (a.is_point() && b.is_point()) return distance_of_points(a, b, result);
    const bool known =
        a.is_point() ? distance_from_point(b, a, false, reach, result) : distance_from_point(a, b, true, reach, result);
    return known ? PlaneAnswer::within : PlaneAnswer::beyond;
}

}  // namespace

PlaneAnswer plane_near(const Outline& a, const Outline& b, double reach, Cache* cache) {
    if (a.is_point() || b.is_point()) {
        SignedDistance<2> distance;
        const PlaneAnswer answer = distance_of_round(a, b, reach, distance);
        return answer == PlaneAnswer::within && distance.distance > reach ? PlaneAnswer::beyond : answer;
    }
    const PolygonPair pair(a, b);
    return pair.near(reach + a.radius + b.radius, cache);
}

PlaneAnswer plane_distance(const Outline& a, const Outline& b, Cache* cache, SignedDistance<2>& distance) {
    if (a.is_point() || b.is_point()) return distance_of_round(a, b, everywhere, distance);
    const PolygonPair pair(a, b);
    Meeting meeting;
    if (pair.meet(everywhere, cache, meeting) == PlaneAnswer::unknown) return PlaneAnswer::unknown;
    set_distance(pair, meeting, distance);
    return PlaneAnswer::within;
}

PlaneAnswer plane_contact(const Outline& a, const Outline& b, double reach, double margin, Cache* cache,
                          SignedDistance<2>& distance, Manifold<2>& manifold) {
    if (a.is_point() || b.is_point()) {
        const PlaneAnswer answer = distance_of_round(a, b, reach, distance);
        if (answer != PlaneAnswer::within) return answer;
        if (distance.distance > reach) return PlaneAnswer::beyond;
        manifold.count = 1;
        manifold.points[0] = {distance.on_a + distance.normal * (0.5 * distance.distance), -distance.distance,
                              point_name(distance.corners)};
        return answer;
    }
    const PolygonPair pair(a, b);
    Meeting meeting;
    const PlaneAnswer answer = pair.meet(reach + a.radius + b.radius, cache, meeting);
    if (answer != PlaneAnswer::within) return answer;
    set_distance(pair, meeting, distance);
    set_polygon_manifold(pair, meeting, distance, margin, manifold);
    return answer;
}

}  // namespace abut
