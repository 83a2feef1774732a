#include <abut/convex/plane_pair.hpp>
#include <abut/convex/polygon_manifold.hpp>
#include <abut/convex/round_pairs.hpp>

namespace abut {
namespace {

constexpr double everywhere = std::numeric_limits<double>::infinity();

/// What is nearer to a corner than this, seen from coordinates of size 1, may be rounding.
constexpr double on_it = 0x1p-30;

bool is_point(const Convex<2>& convex) {
    return is_round_points(convex, 1);
}

PlaneAnswer distance_of_points(const Convex<2>& a, const Convex<2>& b, SignedDistance<2>& result) {
    const DVec<2> from = core_corner(a, 0), between = core_corner(b, 0) - from;
    const double gap = length(between);
    if (!(gap > 0)) return PlaneAnswer::unknown;
    result.distance = gap - a.radius - b.radius;
    result.normal = between / gap;
    result.on_a = from + result.normal * a.radius;
    result.corners = {};
    result.corners.count = 2;
    return PlaneAnswer::within;
}

/// A polygon and a point: the side that the point is farthest in front of holds the nearest place, or ends there.
PlaneAnswer distance_from_point(const Convex<2>& polygon, const Convex<2>& round, bool polygon_is_a, double reach,
                                SignedDistance<2>& result) {
    FewSides room;
    Sides sides;
    if (!sides_of(polygon, room, sides)) return PlaneAnswer::unknown;
    const DVec<2> center = core_corner(round, 0);
    const DVec<2> point = polygon.place.transposed(center - polygon.place.offset);
    const SideGap found = widest_gap(sides, point);
    const double radii = polygon.radius + round.radius;
    if (found.gap - radii > reach) return PlaneAnswer::beyond;

    DVec<2> normal = sides.normal(found.side);
    double gap = found.gap;
    std::uint32_t first = found.side, second = sides.after(found.side);
    const double along = dot(sides.along(first), point - sides.corner(first));
    const bool before = along < 0, past = !before && along > sides.length(first);
    if (before || past) {
        std::uint32_t corner = before ? first : second;
        if (gap > 0 || sides.count == 2) {
            // Of sides that lie on one line, to rounding, not the right one may have been found.
            Lean to = lean(sides, corner, point - sides.corner(corner));
            for (std::uint32_t i = 0; i < sides.count && to.leans && !(to.along > 0 && to.along < to.length); ++i) {
                corner = to.along > 0 ? sides.after(to.side) : to.side;
                to = lean(sides, corner, point - sides.corner(corner));
            }
            first = to.leans ? to.side : corner;
            second = to.leans ? sides.after(first) : corner;
            const DVec<2> from = point - sides.corner(corner);
            const double away = length(from);
            if (!to.leans && away > on_it * (largest(point) + sides.size)) {
                gap = away;
                normal = from / away;
            }
        } else {
            first = before ? sides.before(first) : second;
            second = sides.after(first);
        }
    }
    result.distance = gap - radii;
    if (result.distance > reach) return PlaneAnswer::beyond;
    const DVec<2> out = polygon.place.vector(normal);
    const std::array<std::uint32_t, 3> corners{sides.corner_number(first), sides.corner_number(second), 0};
    result.corners = {};
    result.corners.count = 2;
    result.normal = polygon_is_a ? out : -out;
    result.on_a = center - out * (polygon_is_a ? gap - polygon.radius : round.radius);
    (polygon_is_a ? result.corners.a : result.corners.b) = corners;
    return PlaneAnswer::within;
}

void set_distance(const PolygonPair& pair, const Meeting& meeting, SignedDistance<2>& result) {
    const Convex<2>&a = pair.shape(0), &b = pair.shape(1), &reference = pair.shape(meeting.of);
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
PlaneAnswer distance_of_round(const Convex<2>& a, const Convex<2>& b, double reach, SignedDistance<2>& result) {
    if (!is_point(a)) return distance_from_point(a, b, true, reach, result);
    if (!is_point(b)) return distance_from_point(b, a, false, reach, result);
    return distance_of_points(a, b, result);
}

}  // namespace

PlaneAnswer plane_near(const Convex<2>& a, const Convex<2>& b, double reach, Cache* cache) {
    if (is_point(a) || is_point(b)) {
        SignedDistance<2> distance;
        const PlaneAnswer answer = distance_of_round(a, b, reach, distance);
        return answer == PlaneAnswer::within && distance.distance > reach ? PlaneAnswer::beyond : answer;
    }
    const PolygonPair pair(a, b);
    return pair.known() ? pair.near(reach + a.radius + b.radius, cache) : PlaneAnswer::unknown;
}

PlaneAnswer plane_distance(const Convex<2>& a, const Convex<2>& b, Cache* cache, SignedDistance<2>& distance) {
    if (is_point(a) || is_point(b)) return distance_of_round(a, b, everywhere, distance);
    const PolygonPair pair(a, b);
    Meeting meeting;
    if (!pair.known() || pair.meet(everywhere, cache, meeting) == PlaneAnswer::unknown) return PlaneAnswer::unknown;
    set_distance(pair, meeting, distance);
    return PlaneAnswer::within;
}

PlaneAnswer plane_contact(const Convex<2>& a, const Convex<2>& b, double reach, double margin, Cache* cache,
                          SignedDistance<2>& distance, Manifold<2>& manifold) {
    if (is_point(a) || is_point(b)) {
        const PlaneAnswer answer = distance_of_round(a, b, reach, distance);
        if (answer != PlaneAnswer::within) return answer;
        if (distance.distance > reach) return PlaneAnswer::beyond;
        // A side meets the round one in its only point; a corner is named after itself.
        const MeetingCorners<2>& corners = distance.corners;
        const bool at_corner = corners.a[0] == corners.a[1] && corners.b[0] == corners.b[1];
        manifold.count = 1;
        manifold.points[0] = {distance.on_a + distance.normal * (0.5 * distance.distance), -distance.distance,
                              at_corner ? corners.a[0] << 8 ^ corners.b[0] : 0};
        return answer;
    }
    const PolygonPair pair(a, b);
    if (!pair.known()) return PlaneAnswer::unknown;
    Meeting meeting;
    const PlaneAnswer answer = pair.meet(reach + a.radius + b.radius, cache, meeting);
    if (answer != PlaneAnswer::within) return answer;
    set_distance(pair, meeting, distance);
    manifold = polygon_manifold(pair, meeting, distance, margin);
    return answer;
}

}  // namespace abut
