#include <abut/convex/pairs/pair2.hpp>

namespace abut::detail {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// Calls query(pair) with the pair's cores: without rows if neither has any.
template <class Query>
[[gnu::always_inline]] inline PairAnswer with_cores(PlacedPolygon& a, PlacedPolygon& b, const Query& query) {
    if (a.core != PlacedPolygon::Core::polygon && b.core != PlacedPolygon::Core::polygon)
        return query(CorePair<BoxCore>(a, b));
    if (a.core != PlacedPolygon::Core::polygon) a.make_rows();
    if (b.core != PlacedPolygon::Core::polygon) b.make_rows();
    return query(CorePair<PolygonCore>(a, b));
}

template <class Core>
inline void set_numbers(const Core& a, const Core& b, ClosestFeatures2& closest) {
    for (std::uint32_t i = 0; i < 2; ++i) {
        closest.corners[0][i] = a.number(closest.corners[0][i]);
        closest.corners[1][i] = b.number(closest.corners[1][i]);
    }
}

/// Pairs of which one is a point.
inline PairAnswer closest_of_points(const PlacedPolygon& a, const PlacedPolygon& b, double reach,
                                    ClosestFeatures2& closest) {
    const std::uint32_t of = b.is_point() ? 0 : 1;
    const PlacedPolygon &shape = of == 0 ? a : b, &point = of == 0 ? b : a;
    return with_core(shape, point.place.position, [&](const auto& core, const ScaledPoint& local) {
        PointFeatures2 found;
        const PairAnswer answer = closest_to_point(core, {point.place.position, point.radius, local}, reach, found);
        if (answer != PairAnswer::yes) return answer;
        closest.of = of;
        closest.set_corners(core.number(found.first), core.number(found.second), 0);
        closest.gap = found.gap;
        closest.normal = found.normal;
        closest.on_other = point.place.position;
        closest.on_reference = found.on_core(core, point.place.position);
        return answer;
    });
}

/// The feature is zero for an edge, the corner's number for a corner.
inline void set_only_point(const PlacedPolygon& a, const PlacedPolygon& b, const ClosestFeatures2& closest,
                           ContactLanes& points) {
    const double depth = a.radius + b.radius - closest.gap;
    const Double2 position = closest.midway(closest.of == 0 ? b.radius : a.radius, depth);
    const auto& corners = closest.corners;
    const bool at_corner = corners[0][0] == corners[0][1] && corners[1][0] == corners[1][1];
    points.x = lanes::first(position);
    points.y = lanes::second(position);
    points.depth = lanes::double2(depth);
    points.features[0] = (corners[0][0] << 8 ^ corners[1][0]) & (0u - (at_corner ? 1u : 0u));
    points.mask = 1;
}

}  // namespace

PairAnswer pair2_within(PlacedPolygon& a, PlacedPolygon& b, double reach, Cache* cache) {
    if (a.is_point() || b.is_point()) {
        ClosestFeatures2 closest;
        return closest_of_points(a, b, reach, closest);
    }
    const double reach_of_cores = reach + (a.radius + b.radius);
    if (!is_finite(a.radius + b.radius)) return PairAnswer::unknown;
    return with_cores(a, b, [&](auto pair) { return pair.within(reach_of_cores, cache); });
}

PairAnswer pair2_closest(PlacedPolygon& a, PlacedPolygon& b, Cache* cache, ClosestFeatures2& closest) {
    if (a.is_point() || b.is_point()) return closest_of_points(a, b, unlimited, closest);
    if (!is_finite(a.radius + b.radius)) return PairAnswer::unknown;
    return with_cores(a, b, [&](auto pair) {
        const PairAnswer answer = pair.find_closest(unlimited, cache, closest);
        if (answer == PairAnswer::yes) set_numbers(pair.shape(0), pair.shape(1), closest);
        return answer;
    });
}

PairAnswer pair2_contact(PlacedPolygon& a, PlacedPolygon& b, double reach, double margin, Cache* cache,
                         ClosestFeatures2& closest, ContactLanes& points) {
    if (a.is_point() || b.is_point()) {
        const PairAnswer answer = closest_of_points(a, b, reach, closest);
        if (answer == PairAnswer::yes) set_only_point(a, b, closest, points);
        return answer;
    }
    const double reach_of_cores = reach + (a.radius + b.radius);
    if (!is_finite(a.radius + b.radius)) return PairAnswer::unknown;
    return with_cores(a, b, [&](auto pair) {
        const PairAnswer answer = pair.find_closest(reach_of_cores, cache, closest);
        if (answer != PairAnswer::yes) return answer;
        find_contact_points(pair, closest, margin, points);
        set_numbers(pair.shape(0), pair.shape(1), closest);
        return answer;
    });
}

}  // namespace abut::detail
