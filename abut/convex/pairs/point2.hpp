#pragma once

// The Voronoi region of a polygon or box that contains a point: that of an edge or of a vertex; and pairs of a shape
// and a point, the core of a circle. Inline, because it runs in every query with a circle. For .cpp files.

#include <abut/convex/pairs/pair_answer.hpp>
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

/// The region for a point past an end of the edge `side`, in front of which it has the height `gap`. It handles the
/// points that are not clearly outside in the region of that corner.
PointLocation locate_past_edge(PolygonSoa sides, Double2 point, std::uint32_t side, double gap);

/// Doubles with an index in their last bits, so that a maximum also gives its index.
struct IndexedLanes {
    static constexpr std::uint64_t index_mask = 15;

    /// The bits of each index.
    alignas(16) static constexpr std::uint64_t numbers[max_soa_edges] = {15, 14, 13, 12, 11, 10, 9, 8,
                                                                         7,  6,  5,  4,  3,  2,  1, 0};
    static lanes::Double2 put(lanes::Double2 v, const std::uint64_t* number) {
        return lanes::with_low_bits(v, index_mask, number);
    }
    static std::uint32_t number(lanes::Double2 v) {
        return static_cast<std::uint32_t>(index_mask - (std::bit_cast<std::uint64_t>(v[0]) & index_mask));
    }
    static double value(lanes::Double2 v) { return lanes::without_bits(v, index_mask)[0]; }
};
static_assert(max_soa_edges == IndexedLanes::index_mask + 1);

enum class Near : std::uint8_t { beyond, within, unclear };

/// A point in the frame of a shape, to be multiplied by `scale`.
struct ScaledPoint {
    Double2 unscaled, scale;

    Double2 point() const { return unscaled * scale; }
};

/// The location of a point in the polygon's frame. Beyond `reach` only the gap is set, which is not finite if the point
/// isn't. If the result is `unclear`, the caller calls `locate_past_edge`.
///
/// The branches here can't be predicted, and the dependency chains are long. So the root and the quotient of the
/// distances from both ends of the edge begin before it is known which one is needed.
[[gnu::always_inline]] inline Near locate_point(const PolygonSoa& sides, const ScaledPoint& local, double reach,
                                                PointLocation& place) {
    using namespace lanes;
    const Double2 unscaled_x = first(local.unscaled), unscaled_y = second(local.unscaled);
    Double2 widest = double2(-std::numeric_limits<double>::infinity());
    const double *numbers = sides.at(0), *const end = numbers + soa_rows * sides.capacity();
    const std::uint64_t* index = IndexedLanes::numbers;
    for (; numbers != end; numbers += soa_rows * soa_lanes, index += soa_lanes) {
        for (std::size_t i = 0; i < soa_lanes; i += 2) {
            const Double2 height = aligned_at(numbers + 2 * soa_lanes + i) * unscaled_x +
                                   aligned_at(numbers + 3 * soa_lanes + i) * unscaled_y;
            const Double2 gap = height * local.scale - aligned_at(numbers + 4 * soa_lanes + i);
            widest = greater(IndexedLanes::put(gap, index + i), widest);
        }
    }
    widest = greater(widest, swapped(widest));
    place.gap = IndexedLanes::value(widest);
    if (!(place.gap <= reach)) return Near::beyond;
    const std::uint32_t side = IndexedLanes::number(widest), after = sides.after(side);

    const Double2 point = local.point(), x = first(point), y = second(point);
    const double normal_x = sides.normal_x(side), normal_y = sides.normal_y(side);
    place.normal = double2(normal_x, normal_y);
    place.first = side;
    place.second = after;
    // From the start and from the end of the edge.
    const Double2 from_x = x - double2(sides.x(side), sides.x(after)),
                  from_y = y - double2(sides.y(side), sides.y(after));
    const Double2 squares = from_x * from_x + from_y * from_y;
    // Behind the start: x of the normal times y is less than y times x. Beyond the end: greater.
    const Double2 left = double2(normal_x) * from_y, right = double2(normal_y) * from_x;
    const Mask2 behind = ends(left, right) < ends(right, left);
    const std::uint32_t past = bits(behind);
    if (past == 0) return Near::within;

    const Double2 away = root(squares), inverse_away = away * (Double2{1, 1} / squares);
    const std::uint32_t before = past & 1, last = (side == 0 ? sides.count : side) - 1;
    const std::uint32_t next = after ^ ((after ^ last) & (0u - before));
    const Mask2 start = first(behind);
    const Double2 from = select(start, lower(from_x, from_y), upper(from_x, from_y));
    const double outside = sides.normal_x(next) * from[1] - sides.normal_y(next) * from[0];
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

[[gnu::always_inline]] inline bool locate(const PolygonCore& core, const ScaledPoint& local, double reach,
                                          PointLocation& place) {
    const Near near = locate_point(core.sides(), local, reach, place);
    if (near == Near::unclear) place = locate_past_edge(core.sides(), local.point(), place.first, place.gap);
    return near == Near::within || (near == Near::unclear && place.gap <= reach);
}
[[gnu::always_inline]] inline bool locate(const BoxCore& core, const ScaledPoint& local, double reach,
                                          PointLocation& place) {
    using namespace lanes;
    const Double2 point = local.point();
    const Double2 beyond = magnitude(point) - core.half(), outside = greater(beyond, Double2{0, 0});
    const std::uint32_t back = bits(point < Double2{0, 0});
    if (bits(beyond > Double2{0, 0}) == 3) {
        const Double2 square = lanes::dot(outside, outside), away = root(square),
                      per_away = away * (Double2{1, 1} / square);
        static constexpr std::uint32_t corners[4] = {0, 1, 3, 2};
        place.gap = away[0];
        place.normal = flipped_by(outside * per_away, point);
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

inline bool is_finite(double number) {
    return std::abs(number) < std::numeric_limits<double>::infinity();
}

/// Whether the root of a square is certain to be above `reach`: roots are slow. False for infinity and NaN.
inline bool is_beyond(double square, double reach) {
    return square > reach * reach * (1 + 0x1p-50) && square <= std::numeric_limits<double>::max();
}

/// The closest features of a core and a point, or those of the minimum penetration, in the world.
struct PointFeatures2 {
    double gap;                   ///< between the core and the point; below zero: penetration
    Double2 normal;               ///< of length 1, out of the core
    std::uint32_t first, second;  ///< the ends of an edge of the core, or one corner twice

    bool at_corner() const { return first == second; }
    /// The name of a contact with a corner, or an edge of length 0; zero for another edge. Branchless.
    template <class Core>
    std::uint32_t corner_name(const Core& core) const {
        const std::uint32_t name = core.number(first);
        return name & (0u - (name == core.number(second) ? 1u : 0u));
    }
    /// On the core; exact at a corner.
    template <class Core>
    Double2 on_core(const Core& core, Double2 point) const {
        return at_corner() ? core.place().point(core.corner(first)) : point - normal * lanes::double2(gap);
    }
    /// Midway between the surfaces of the core and the point, which has a ball of `radius` around it.
    Double2 midway(Double2 point, double radius, double depth) const {
        return point - normal * lanes::double2(radius - 0.5 * depth);
    }
};

/// A point with a ball around it, in the world, and its place in the frame of a core.
struct RoundPoint {
    Double2 center;
    double radius;
    ScaledPoint local;
};

/// If the distance of the two with their balls is at most `reach`.
template <class Core>
[[gnu::always_inline]] inline PairAnswer closest_to_point(const Core& core, const RoundPoint& point, double reach,
                                                          PointFeatures2& closest) {
    const double balls = core.radius() + point.radius;
    PointLocation found;
    const bool near = locate(core, point.local, reach + balls, found);
    if (!is_finite(found.gap + balls)) return PairAnswer::unknown;
    if (!near) return PairAnswer::no;
    closest.gap = found.gap;
    closest.normal = core.place().vector(found.normal);
    closest.first = found.first;
    closest.second = found.second;
    return PairAnswer::yes;
}
[[gnu::always_inline]] inline PairAnswer closest_to_point(const PointCore& core, const RoundPoint& point, double reach,
                                                          PointFeatures2& closest) {
    const Double2 between = point.center - core.place().position, square = lanes::dot(between, between);
    const double balls = core.radius() + point.radius;
    if (is_beyond(square[0], reach + balls)) return PairAnswer::no;
    const Double2 gap = lanes::root(square);
    if (!(gap[0] > 0 && is_finite(gap[0] + balls))) return PairAnswer::unknown;
    closest.gap = gap[0];
    closest.normal = between * (gap * (Double2{1, 1} / square));
    closest.first = closest.second = 0;
    return gap[0] > reach + balls ? PairAnswer::no : PairAnswer::yes;
}

/// A point in the frame of a shape.
inline ScaledPoint seen_from(const PlacedPolygon& shape, Double2 point) {
    return {shape.place.back(point - shape.place.position), lanes::double2(1)};
}

/// Calls query(core, the point in the core's frame) with the shape's core.
template <class Query>
[[gnu::always_inline]] inline PairAnswer with_core(const PlacedPolygon& shape, Double2 point, const Query& query) {
    switch (shape.core) {
        case PlacedPolygon::Core::point:
            return query(PointCore(shape), ScaledPoint{});
        case PlacedPolygon::Core::box:
            return query(BoxCore(shape), seen_from(shape, point));
        default:
            return query(PolygonCore(shape), seen_from(shape, point));
    }
}

}  // namespace abut::detail
