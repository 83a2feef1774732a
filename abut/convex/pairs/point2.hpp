#pragma once

// The Voronoi region of a polygon that contains a point: that of an edge or of a vertex. Inline, because it runs in
// every query with a circle. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/polygon_soa.hpp>
#include <abut/math/simd/double2-inl.h>

#include <limits>

namespace abut::detail {

/// The location of a point relative to a polygon: in the region of an edge, or of a vertex, which occurs twice.
struct PointLocation {
    double gap;             ///< below zero inside
    lanes::Double2 normal;  ///< from the closest point on the polygon to the query point, at distance `gap`
    std::uint32_t first, second;
};

/// A smaller distance to a corner, relative to the coordinates, may be rounding.
inline constexpr double on_corner = 0x1p-30;

/// The region for a point past the end of the edge that was found: in `place` its first or second corner. It handles
/// the points that are not clearly outside in the region of that corner.
void locate_past_edge(const PolygonSoa& sides, const DVec<2>& point, PointLocation& place);

/// Doubles with an index in their last bits, so that a maximum also gives its index.
struct IndexedLanes {
    static constexpr long long index_mask = 15;

    /// For two in a row, the first of which has the index 2 `pair`.
    static lanes::Double2 put(lanes::Double2 v, std::size_t pair) {
        alignas(16) static constexpr long long numbers[max_soa_edges] = {15, 14, 13, 12, 11, 10, 9, 8,
                                                                         7,  6,  5,  4,  3,  2,  1, 0};
        lanes::Mask2 number;
        __builtin_memcpy(&number, numbers + 2 * pair, sizeof(number));
        return reinterpret_cast<lanes::Double2>((reinterpret_cast<lanes::Mask2>(v) & ~index_mask) | number);
    }
    static std::uint32_t number(lanes::Double2 v) {
        return static_cast<std::uint32_t>(index_mask - (reinterpret_cast<lanes::Mask2>(v)[0] & index_mask));
    }
    static double value(lanes::Double2 v) {
        return reinterpret_cast<lanes::Double2>(reinterpret_cast<lanes::Mask2>(v) & ~index_mask)[0];
    }
};
static_assert(max_soa_edges == IndexedLanes::index_mask + 1);

enum class Near : std::uint8_t { beyond, within, unclear };

/// The location of a point, at `point` times `scale` in the polygon's frame. Beyond `reach` only the gap is set, which
/// is not finite if the point isn't. If the result is `unclear`, the caller calls `locate_past_edge`.
///
/// The branches here can't be predicted, and the dependency chains are long. So the root and the quotient of the
/// distances from both ends of the edge begin before it is known which one is needed.
__attribute__((always_inline)) inline Near locate_point(const PolygonSoa& sides, lanes::Double2 point,
                                                        lanes::Double2 scale, double reach, PointLocation& place) {
    using namespace lanes;
    const Double2 x = first(point), y = second(point);
    Double2 widest = double2(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; 2 * i < sides.count; ++i) {
        const Double2 height = (at(sides.normal_x + 2 * i) * x + at(sides.normal_y + 2 * i) * y) * scale;
        widest = greater(IndexedLanes::put(height - at(sides.offset + 2 * i), i), widest);
    }
    widest = greater(widest, swapped(widest));
    place.gap = IndexedLanes::value(widest);
    if (!(place.gap <= reach)) return Near::beyond;
    const std::uint32_t side = IndexedLanes::number(widest), after = sides.after(side);

    const double normal_x = sides.normal_x[side], normal_y = sides.normal_y[side];
    place.normal = double2(normal_x, normal_y);
    place.first = side;
    place.second = after;
    // From the start and from the end of the edge.
    const Double2 from_x = x * scale - double2(sides.x[side], sides.x[after]),
                  from_y = y * scale - double2(sides.y[side], sides.y[after]);
    const Double2 squares = from_x * from_x + from_y * from_y;
    const Double2 parts = (double2(normal_x) * from_y - double2(normal_y) * from_x) * Double2{1, -1};
    const std::uint32_t past = bits(parts < Double2{0, 0});
    if (past == 0) return Near::within;

    const Double2 away = root(squares), inverse_away = away * (Double2{1, 1} / squares);
    const std::uint32_t before = past & 1, last = (side == 0 ? sides.count : side) - 1;
    const std::uint32_t next = after ^ ((after ^ last) & (0u - before));
    const Mask2 start = first(parts) < Double2{0, 0};
    const Double2 from = select(start, lower(from_x, from_y), upper(from_x, from_y));
    const double outside = sides.normal_x[next] * from[1] - sides.normal_y[next] * from[0];
    static constexpr double outwards[2] = {-1, 1};
    const Double2 sizes = magnitude(point) + magnitude(point) + magnitude(from);
    const double gap = select(start, away, swapped(away))[0];
    if (!(place.gap > 0 && outside * outwards[before] >= 0 && gap > on_corner * (sizes[0] + sizes[1])))
        return Near::unclear;
    place.gap = gap;
    place.normal = from * select(start, first(inverse_away), second(inverse_away));
    place.first = place.second = after ^ ((after ^ side) & (0u - before));
    return gap <= reach ? Near::within : Near::beyond;
}

/// A polygon and a point with balls around them. Returns false if the distance is above `reach`.
inline bool distance_from_point(const PlacedPolygon& polygon, const PlacedPolygon& round, bool polygon_is_a,
                                double reach, SignedDistance<2>& result) {
    const PolygonSoa& sides = polygon.sides;
    const DVec<2> center = round.place.offset(), point = polygon.place.inverse_point(center);
    const double radii = polygon.radius + round.radius;
    PointLocation place;
    const Near near = locate_point(sides, lanes::double2(point.x, point.y), lanes::double2(1), reach + radii, place);
    if (near == Near::beyond) return false;
    if (near == Near::unclear) {
        locate_past_edge(sides, point, place);
        if (!(place.gap <= reach + radii)) return false;
    }
    const DVec<2> out = polygon.place.vector({place.normal[0], place.normal[1]});
    const std::uint32_t first = sides.corner_number(place.first), second = sides.corner_number(place.second);
    result.distance = place.gap - radii;
    result.normal = polygon_is_a ? out : -out;
    // In the polygon's frame, so that a closest point at a corner is exactly there.
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

/// The feature of the only contact point: zero for an edge, the corner's number for a corner.
inline std::uint32_t point_name(const ClosestCorners<2>& corners) {
    const bool at_corner = corners.a[0] == corners.a[1] && corners.b[0] == corners.b[1];
    return (corners.a[0] << 8 ^ corners.b[0]) & (0u - (at_corner ? 1u : 0u));
}

}  // namespace abut::detail
