#pragma once

// The Voronoi region of a polygon or box that contains a point: that of an edge or of a vertex. Inline, because it runs
// in every query with a circle. For .cpp files.

#include <abut/convex/pairs/polygon_cores2.hpp>

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

/// The location of a point in the polygon's frame. Beyond `reach` only the gap is set, which is not finite if the point
/// isn't. If the result is `unclear`, the caller calls `locate_past_edge`.
///
/// The branches here can't be predicted, and the dependency chains are long. So the root and the quotient of the
/// distances from both ends of the edge begin before it is known which one is needed.
[[gnu::always_inline]] inline Near locate_point(const PolygonSoa& sides, lanes::Double2 point, double reach,
                                                PointLocation& place) {
    using namespace lanes;
    const Double2 x = first(point), y = second(point);
    Double2 widest = double2(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; 2 * i < sides.count; ++i) {
        const Double2 height = at(sides.normal_x() + 2 * i) * x + at(sides.normal_y() + 2 * i) * y;
        widest = greater(IndexedLanes::put(height - at(sides.offset() + 2 * i), i), widest);
    }
    widest = greater(widest, swapped(widest));
    place.gap = IndexedLanes::value(widest);
    if (!(place.gap <= reach)) return Near::beyond;
    const std::uint32_t side = IndexedLanes::number(widest), after = sides.after(side);

    const double normal_x = sides.normal_x()[side], normal_y = sides.normal_y()[side];
    place.normal = double2(normal_x, normal_y);
    place.first = side;
    place.second = after;
    // From the start and from the end of the edge.
    const Double2 from_x = x - double2(sides.x()[side], sides.x()[after]),
                  from_y = y - double2(sides.y()[side], sides.y()[after]);
    const Double2 squares = from_x * from_x + from_y * from_y;
    const Double2 parts = (double2(normal_x) * from_y - double2(normal_y) * from_x) * Double2{1, -1};
    const std::uint32_t past = bits(parts < Double2{0, 0});
    if (past == 0) return Near::within;

    const Double2 away = root(squares), inverse_away = away * (Double2{1, 1} / squares);
    const std::uint32_t before = past & 1, last = (side == 0 ? sides.count : side) - 1;
    const std::uint32_t next = after ^ ((after ^ last) & (0u - before));
    const Mask2 start = first(parts) < Double2{0, 0};
    const Double2 from = select(start, lower(from_x, from_y), upper(from_x, from_y));
    const double outside = sides.normal_x()[next] * from[1] - sides.normal_y()[next] * from[0];
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

// These return false if the distance is above `reach`.

inline bool locate(const PolygonCore& core, Double2 point, double reach, PointLocation& place) {
    const Near near = locate_point(core.sides(), point, reach, place);
    if (near == Near::unclear) locate_past_edge(core.sides(), {point[0], point[1]}, place);
    return near == Near::within || (near == Near::unclear && place.gap <= reach);
}
/// The signs are those of another vector.
inline Double2 with_signs_of(Double2 v, Double2 signs) {
    const lanes::Mask2 magnitudes = lanes::Mask2{0, 0} + 0x7fffffffffffffff;
    return lanes::select(magnitudes, v, signs);
}
inline bool locate(const BoxCore& core, Double2 point, double reach, PointLocation& place) {
    using namespace lanes;
    const Double2 beyond = magnitude(point) - core.half(), outside = greater(beyond, Double2{0, 0});
    const std::uint32_t back = bits(point < Double2{0, 0});
    if (bits(beyond > Double2{0, 0}) == 3) {
        const Double2 square = lanes::dot(outside, outside), away = root(square),
                      per_away = away * (Double2{1, 1} / square);
        static constexpr std::uint32_t corners[4] = {0, 1, 3, 2};
        place.gap = away[0];
        place.normal = with_signs_of(outside * per_away, point);
        place.first = place.second = corners[back];
    } else {
        const std::uint32_t along_x = beyond[0] > beyond[1] ? 1 : 0;
        static constexpr std::uint32_t sides[8] = {0, 0, 2, 2, 3, 1, 3, 1};
        place.gap = std::max(beyond[0], beyond[1]);
        place.first = sides[along_x << 2 | back];
        place.second = core.after(place.first);
        place.normal = core.normal(place.first);
    }
    return place.gap <= reach;
}

}  // namespace abut::detail
