#include <abut/convex/pairs/pair2.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/placed_polygon2.hpp>
#include <abut/query/detail/part_pairs.hpp>

namespace abut::detail {
namespace {

/// Both shapes as placed polygons.
struct PolygonsOfShapes {
    PlacedPolygon a, b;
    bool known;

    PolygonsOfShapes(const ShapeRef<2>& first, const ShapeRef<2>& second)
        : known(set_placed_polygon(first, a) && set_placed_polygon(second, b)) {}
};

template <class Answer>
void name_features(const ClosestFeatures2& closest, Answer& answer) {
    name_end_or_edge<2>({closest.corners[0][0], closest.corners[0][1]}, 0, answer.feature_a);
    name_end_or_edge<2>({closest.corners[1][0], closest.corners[1][1]}, 0, answer.feature_b);
}

}  // namespace

PairAnswer closed_form_overlap(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache) {
    PolygonsOfShapes polygons(a, b);
    if (!polygons.known) return PairAnswer::unknown;
    return pair2_within(polygons.a, polygons.b, 0, cache);
}

}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

// Out of line, to keep the fast path small.

[[gnu::noinline]] void closest_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Closest<2>& result) {
    result = closest(convex_of(a), convex_of(b), options);
}
[[gnu::noinline]] void contact_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Contact<2>& result) {
    result = contact(convex_of(a), convex_of(b), options);
}

}  // namespace

// The results are written in place: a copy right after the writes would stall.

template <>
Closest<2> closest(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    Closest<2> result;
    PolygonsOfShapes polygons(a, b);
    ClosestFeatures2 found;
    if (options.trace == nullptr && polygons.known &&
        pair2_closest(polygons.a, polygons.b, options.cache, found) != PairAnswer::unknown) {
        const Double2 out = found.from_a();
        result.distance = static_cast<float>(found.gap - polygons.a.radius - polygons.b.radius);
        lanes::store(out, &result.normal.x);
        lanes::store(found.on_a() + out * lanes::double2(polygons.a.radius), &result.on_a.x);
        lanes::store(found.on_b() - out * lanes::double2(polygons.b.radius), &result.on_b.x);
        name_features(found, result);
    } else {
        closest_of_views(a, b, options, result);
    }
    return result;
}

template <>
Contact<2> contact(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    Contact<2> result;
    result.normal[0] = 1;
    PolygonsOfShapes polygons(a, b);
    ClosestFeatures2 found;
    ContactLanes points;
    const double margin = static_cast<double>(options.margin);
    const PairAnswer answer = options.trace != nullptr || !polygons.known
                                  ? PairAnswer::unknown
                                  : pair2_contact(polygons.a, polygons.b, margin, margin, options.cache, found, points);
    if (answer == PairAnswer::unknown) contact_of_views(a, b, options, result);
    if (answer == PairAnswer::yes) {
        lanes::store(found.from_a(), &result.normal.x);
        result.depth = static_cast<float>(polygons.a.radius + polygons.b.radius - found.gap);
        for (std::uint32_t i = 0; i < 2; ++i)
            if ((points.mask >> i & 1u) != 0)
                result.points.push_back({{static_cast<float>(points.x[i]), static_cast<float>(points.y[i])},
                                         static_cast<float>(points.depth[i]),
                                         points.features[i]});
        name_features(found, result);
    }
    return result;
}

}  // namespace abut
