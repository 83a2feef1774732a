#pragma once

// A point beside a polygon: in front of a side, or past one of its ends. So little that it is done in place. For .cpp
// files.

#include <abut/convex/sides.hpp>
#include <abut/convex/signed_distance.hpp>

namespace abut {

/// Where a point lies about a polygon: in front of a side, or of a corner, which is told twice.
struct PlaceOfPoint {
    double gap;          ///< below zero inside
    DVec<2> normal, on;  ///< `on` is the place on the polygon: of a corner the corner itself
    std::uint32_t first, second;
};

/// What is nearer to a corner than this, seen from coordinates of size 1, may be rounding.
inline constexpr double on_corner = 0x1p-30;

/// Past the end of the side that was found for it, the first or the second of `place`: what is neither plainly outside,
/// in front of the corner there, nor in front of the side.
void look_past_side(const Sides& sides, const DVec<2>& point, bool before, PlaceOfPoint& place);

/// Seen from the polygon. False where it is farther off than `reach`.
__attribute__((always_inline)) inline bool find_place(const Sides& sides, const DVec<2>& point, double reach,
                                                      PlaceOfPoint& place) {
    double widest = -std::numeric_limits<double>::infinity();
    std::uint32_t side = 0;
    for (std::uint32_t i = 0; i < sides.count; ++i) {
        const double gap = (sides.normal_x[i] * point.x + sides.normal_y[i] * point.y) - sides.offset[i];
        if (gap > reach) return false;
        if (!(gap > widest)) continue;
        widest = gap;
        side = i;
    }
    const std::uint32_t after = sides.after(side);
    const DVec<2> start = sides.corner(side), along = sides.along(side);
    const double part = dot(along, point - start);
    place.gap = widest;
    place.normal = sides.normal(side);
    place.first = side;
    place.second = after;
    const bool before = part < 0;
    place.on = point - place.normal * widest;
    if (!before && part <= dot(along, sides.corner(after) - start)) return true;

    const std::uint32_t corner = before ? side : after, next = before ? sides.before(side) : after;
    const DVec<2> from = point - sides.corner(corner);
    const double leans = dot(sides.along(next), from), away = length(from);
    if (widest > 0 && (before ? leans >= 0 : leans <= 0) && away > on_corner * (largest(point) + sides.size)) {
        place.gap = away;
        place.normal = from * (1 / away);
        place.on = sides.corner(corner);
        place.first = place.second = corner;
    } else {
        // From a copy: what is handed on by reference is kept in memory from the start.
        const Sides copy = sides;
        look_past_side(copy, point, before, place);
    }
    return place.gap <= reach;
}

/// A polygon and a point with balls around them. False where they are farther apart than `reach`.
inline bool distance_from_point(const Outline& polygon, const Outline& round, bool polygon_is_a, double reach,
                                SignedDistance<2>& result) {
    const Sides& sides = polygon.sides;
    const DVec<2> center = round.place.offset(), point = polygon.place.unplaced(center);
    const double radii = polygon.radius + round.radius;
    PlaceOfPoint place;
    if (!find_place(sides, point, reach + radii, place)) return false;
    const DVec<2> out = polygon.place.vector(place.normal);
    const std::uint32_t first = sides.corner_number(place.first), second = sides.corner_number(place.second);
    result.distance = place.gap - radii;
    result.normal = polygon_is_a ? out : -out;
    result.on_a = polygon_is_a ? polygon.place.point(place.on) + out * polygon.radius : center - out * round.radius;
    auto &of_polygon = polygon_is_a ? result.corners.a : result.corners.b,
         &of_point = polygon_is_a ? result.corners.b : result.corners.a;
    of_polygon[0] = first;
    of_polygon[1] = second;
    of_point[0] = of_point[1] = 0;
    result.corners.count = 2;
    return true;
}

/// What the only point of such a contact is called: a side meets the round one in its only point; a corner is named
/// after itself.
inline std::uint32_t point_name(const MeetingCorners<2>& corners) {
    const bool at_corner = corners.a[0] == corners.a[1] && corners.b[0] == corners.b[1];
    return (corners.a[0] << 8 ^ corners.b[0]) & (0u - (at_corner ? 1u : 0u));
}

}  // namespace abut
