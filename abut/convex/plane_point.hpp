#pragma once

// A point beside a polygon: in front of a side, or past one of its ends. So little that it is done in place. For .cpp
// files.

#include <abut/convex/sides.hpp>
#include <abut/convex/signed_distance.hpp>
#include <abut/math/lanes-inl.h>

#include <limits>

namespace abut {

/// Where a point lies about a polygon: in front of a side, or of a corner, which is told twice.
struct PlaceOfPoint {
    double gap;          ///< below zero inside
    lanes::Both normal;  ///< from the nearest place on the polygon, which lies `gap` against it from the point
    std::uint32_t first, second;
};

/// What is nearer to a corner than this, seen from coordinates of size 1, may be rounding.
inline constexpr double on_corner = 0x1p-30;

/// Past the end of the side that was found for it, the first or the second of `place`: what is neither plainly outside,
/// in front of the corner there, nor in front of the side.
void look_past_side(const Sides& sides, const DVec<2>& point, PlaceOfPoint& place);

/// Numbers that are nearly the same are told apart by their last bits, which hold which of them it is.
struct Numbered {
    static constexpr long long room = 15;

    /// Of two in a row, the first of which is number 2 `pair`.
    static lanes::Both put(lanes::Both v, std::size_t pair) {
        alignas(16) static constexpr long long numbers[most_sides] = {15, 14, 13, 12, 11, 10, 9, 8,
                                                                      7,  6,  5,  4,  3,  2,  1, 0};
        lanes::Chosen number;
        __builtin_memcpy(&number, numbers + 2 * pair, sizeof(number));
        return reinterpret_cast<lanes::Both>((reinterpret_cast<lanes::Chosen>(v) & ~room) | number);
    }
    static std::uint32_t number(lanes::Both v) {
        return static_cast<std::uint32_t>(room - (reinterpret_cast<lanes::Chosen>(v)[0] & room));
    }
    static double value(lanes::Both v) {
        return reinterpret_cast<lanes::Both>(reinterpret_cast<lanes::Chosen>(v) & ~room)[0];
    }
};
static_assert(most_sides == Numbered::room + 1);

enum class Near : std::uint8_t { beyond, within, unclear };

/// Where a point lies that the polygon sees at `point`, times `scale`. Beyond `reach`, only the gap is known, which is
/// no finite number where the point has none; unclear it is where `look_past_side` is to be asked.
///
/// What is chosen here can't be guessed, and what waits for it is long: the root and the quotient of the distances from
/// both ends of the side are begun before it is known whether one is asked for, and which.
__attribute__((always_inline)) inline Near find_place(const Sides& sides, lanes::Both point, lanes::Both scale,
                                                      double reach, PlaceOfPoint& place) {
    using namespace lanes;
    const Both x = first(point), y = second(point);
    Both widest = both(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; 2 * i < sides.count; ++i) {
        const Both height = (at(sides.normal_x + 2 * i) * x + at(sides.normal_y + 2 * i) * y) * scale;
        widest = greater(Numbered::put(height - at(sides.offset + 2 * i), i), widest);
    }
    widest = greater(widest, swapped(widest));
    place.gap = Numbered::value(widest);
    if (!(place.gap <= reach)) return Near::beyond;
    const std::uint32_t side = Numbered::number(widest), after = sides.after(side);

    const double normal_x = sides.normal_x[side], normal_y = sides.normal_y[side];
    place.normal = both(normal_x, normal_y);
    place.first = side;
    place.second = after;
    // From the start of the side, and from its end.
    const Both from_x = x * scale - both(sides.x[side], sides.x[after]),
               from_y = y * scale - both(sides.y[side], sides.y[after]);
    const Both squares = from_x * from_x + from_y * from_y;
    const Both parts = (both(normal_x) * from_y - both(normal_y) * from_x) * Both{1, -1};
    const std::uint32_t past = bits(parts < Both{0, 0});
    if (past == 0) return Near::within;

    const Both away = root(squares), per_away = away * (Both{1, 1} / squares);
    const std::uint32_t before = past & 1, last = (side == 0 ? sides.count : side) - 1;
    const std::uint32_t next = after ^ ((after ^ last) & (0u - before));
    const Chosen start = first(parts) < Both{0, 0};
    const Both from = chosen(start, lower(from_x, from_y), upper(from_x, from_y));
    const double leans = sides.normal_x[next] * from[1] - sides.normal_y[next] * from[0];
    static constexpr double outwards[2] = {-1, 1};
    const Both sizes = magnitude(point) + magnitude(point) + magnitude(from);
    const double gap = chosen(start, away, swapped(away))[0];
    if (!(place.gap > 0 && leans * outwards[before] >= 0 && gap > on_corner * (sizes[0] + sizes[1])))
        return Near::unclear;
    place.gap = gap;
    place.normal = from * chosen(start, first(per_away), second(per_away));
    place.first = place.second = after ^ ((after ^ side) & (0u - before));
    return gap <= reach ? Near::within : Near::beyond;
}

/// A polygon and a point with balls around them. False where they are farther apart than `reach`.
inline bool distance_from_point(const Outline& polygon, const Outline& round, bool polygon_is_a, double reach,
                                SignedDistance<2>& result) {
    const Sides& sides = polygon.sides;
    const DVec<2> center = round.place.offset(), point = polygon.place.unplaced(center);
    const double radii = polygon.radius + round.radius;
    PlaceOfPoint place;
    const Near near = find_place(sides, lanes::both(point.x, point.y), lanes::both(1), reach + radii, place);
    if (near == Near::beyond) return false;
    if (near == Near::unclear) {
        look_past_side(sides, point, place);
        if (!(place.gap <= reach + radii)) return false;
    }
    const DVec<2> out = polygon.place.vector({place.normal[0], place.normal[1]});
    const std::uint32_t first = sides.corner_number(place.first), second = sides.corner_number(place.second);
    result.distance = place.gap - radii;
    result.normal = polygon_is_a ? out : -out;
    // As the polygon has it, so that what is at a corner is exactly there.
    const DVec<2> on = place.first == place.second ? sides.corner(place.first)
                                                   : point - DVec<2>(place.normal[0], place.normal[1]) * place.gap;
    result.on_a = polygon_is_a ? polygon.place.point(on) + out * polygon.radius : center - out * round.radius;
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
