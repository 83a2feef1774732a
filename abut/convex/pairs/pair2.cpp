#include <abut/convex/manifold/polygon_manifold.hpp>
#include <abut/convex/pairs/pair2.hpp>
#include <abut/convex/pairs/point2.hpp>

namespace abut::detail {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

PairAnswer2 distance_of_points(const PlacedPolygon& a, const PlacedPolygon& b, SignedDistance<2>& result) {
    const DVec<2> from = a.place.offset(), between = b.place.offset() - from;
    const double gap = length(between);
    if (!(gap > 0)) return PairAnswer2::unknown;
    result.distance = gap - a.radius - b.radius;
    result.normal = between / gap;
    result.on_a = from + result.normal * a.radius;
    result.corners = {};
    result.corners.count = 2;
    return PairAnswer2::within;
}

void set_distance(const PolygonPair& pair, const ClosestFeatures2& closest, SignedDistance<2>& result) {
    const PlacedPolygon &a = pair.polygon(0), &b = pair.polygon(1), &reference = pair.polygon(closest.of);
    const PolygonSoa &sides = pair.sides(closest.of), &other = pair.sides(1 - closest.of);
    const bool a_is_reference = closest.of == 0;
    const DVec<2> out = reference.place.vector(closest.normal);
    result.distance = closest.gap - a.radius - b.radius;
    result.normal = a_is_reference ? out : -out;
    result.on_a =
        reference.place.point(a_is_reference ? closest.on_reference : closest.on_other) + result.normal * a.radius;
    auto &of_reference = a_is_reference ? result.corners.a : result.corners.b,
         &of_other = a_is_reference ? result.corners.b : result.corners.a;
    for (std::size_t i = 0; i < 2; ++i) {
        of_reference[i] = sides.corner_number(closest.reference_corners[i]);
        of_other[i] = other.corner_number(closest.other_corners[i]);
    }
    result.corners.count = 2;
}

/// Pairs of which one is a point with a ball.
PairAnswer2 distance_of_round(const PlacedPolygon& a, const PlacedPolygon& b, double reach, SignedDistance<2>& result) {
    if (a.is_point() && b.is_point()) return distance_of_points(a, b, result);
    const bool known =
        a.is_point() ? distance_from_point(b, a, false, reach, result) : distance_from_point(a, b, true, reach, result);
    return known ? PairAnswer2::within : PairAnswer2::beyond;
}

}  // namespace

PairAnswer2 pair2_within(const PlacedPolygon& a, const PlacedPolygon& b, double reach, Cache* cache) {
    if (a.is_point() || b.is_point()) {
        SignedDistance<2> distance;
        const PairAnswer2 answer = distance_of_round(a, b, reach, distance);
        return answer == PairAnswer2::within && distance.distance > reach ? PairAnswer2::beyond : answer;
    }
    const PolygonPair pair(a, b);
    return pair.near(reach + a.radius + b.radius, cache);
}

PairAnswer2 pair2_distance(const PlacedPolygon& a, const PlacedPolygon& b, Cache* cache, SignedDistance<2>& distance) {
    if (a.is_point() || b.is_point()) return distance_of_round(a, b, unlimited, distance);
    const PolygonPair pair(a, b);
    ClosestFeatures2 closest;
    if (pair.find_closest(unlimited, cache, closest) == PairAnswer2::unknown) return PairAnswer2::unknown;
    set_distance(pair, closest, distance);
    return PairAnswer2::within;
}

PairAnswer2 pair2_contact(const PlacedPolygon& a, const PlacedPolygon& b, double reach, double margin, Cache* cache,
                          SignedDistance<2>& distance, Manifold<2>& manifold) {
    if (a.is_point() || b.is_point()) {
        const PairAnswer2 answer = distance_of_round(a, b, reach, distance);
        if (answer != PairAnswer2::within) return answer;
        if (distance.distance > reach) return PairAnswer2::beyond;
        manifold.count = 1;
        manifold.points[0] = {distance.on_a + distance.normal * (0.5 * distance.distance), -distance.distance,
                              point_name(distance.corners)};
        return answer;
    }
    const PolygonPair pair(a, b);
    ClosestFeatures2 closest;
    const PairAnswer2 answer = pair.find_closest(reach + a.radius + b.radius, cache, closest);
    if (answer != PairAnswer2::within) return answer;
    set_distance(pair, closest, distance);
    set_polygon_manifold(pair, closest, distance, margin, manifold);
    return answer;
}

}  // namespace abut::detail
