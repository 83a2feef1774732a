#include <abut/convex/pairs/pair2.hpp>
#include <abut/convex/pairs/point2.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/placed_polygon2.hpp>
#include <abut/query/detail/closed_form/polygons2.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/write_answer.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/polygon.hpp>

namespace abut::detail {

namespace {

/// A sum that is finite only if all its terms are. The other numbers of a polygon follow from these.
inline double sum_of(const PlacedPolygon& polygon, ShapeKind kind) {
    const Rigid2& place = polygon.place;
    const double placed = (place.x + place.y) + (place.cos + place.sin);
    if (kind == ShapeKind::ball) return placed + polygon.radius;
    // Polygon::build has checked that a polygon is finite.
    return kind == ShapeKind::polytope ? placed : placed + (polygon.radius + polygon.sides.size + polygon.sides.area);
}

/// Calls query(polygon of a, polygon of b) if both exist and all their numbers are finite; else returns `otherwise`.
/// Two polygons or two boxes have their own instantiation.
template <class Query, class Answer, class Set>
inline Answer query_of(const ShapeRef<2>& a, const ShapeRef<2>& b, const Query& query, Answer otherwise,
                       const Set& set) {
    PlacedPolygon first, second;
    const bool found = set(a, first) && set(b, second) && std::isfinite(sum_of(first, a.kind) + sum_of(second, b.kind));
    return found ? query(first, second) : otherwise;
}
template <class Query, class Answer>
Answer query_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, const Query& query, Answer otherwise) {
    if (a.kind == b.kind && a.kind == ShapeKind::polytope)
        return query_of(a, b, query, otherwise, set_placed_polygon_of<ShapeKind::polytope>);
    if (a.kind == b.kind && a.kind == ShapeKind::box)
        return query_of(a, b, query, otherwise, set_placed_polygon_of<ShapeKind::box>);
    return query_of(a, b, query, otherwise, [](const ShapeRef<2>& given, PlacedPolygon& polygon) {
        return set_placed_polygon(given, polygon);
    });
}

template <class Answer>
void name_features(const SignedDistance<2>& distance, Answer& answer) {
    name_end_or_edge<2>(distance.corners.a, 0, answer.feature_a);
    name_end_or_edge<2>(distance.corners.b, 0, answer.feature_b);
}

}  // namespace

ClosedFormAnswer closed_form_overlap(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache) {
    if (cache != nullptr && separated_by_cache(a, b, *cache, 0)) return ClosedFormAnswer::no;
    const ClosedFormAnswer of_polygons = overlap_polygons(a, b, cache);
    if (of_polygons != ClosedFormAnswer::unknown) return of_polygons;
    const auto query = [&](const PlacedPolygon& first, const PlacedPolygon& second) {
        const PairAnswer2 answer = pair2_within(first, second, 0, cache);
        return answer == PairAnswer2::unknown  ? ClosedFormAnswer::unknown
               : answer == PairAnswer2::within ? ClosedFormAnswer::yes
                                               : ClosedFormAnswer::no;
    };
    return query_polygons(a, b, query, ClosedFormAnswer::unknown);
}

}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

/// The contact of a circle and a polygon: `pair2_contact` reduced to these two shapes.
inline bool contact_with_circle(const ShapeRef<2>& of_polygon, const ShapeRef<2>& of_circle, bool polygon_is_a,
                                double margin, Contact<2>& result) {
    using lanes::Double2;
    const Polygon& polygon = of_polygon.as<Polygon>();
    const Circle& circle = of_circle.as<Circle>();
    if (polygon.sides() == nullptr || of_circle.pose != nullptr) return false;
    const Pose2& pose = pose_or_none(of_polygon.pose);
    const Double2 turn = lanes::loaded(&pose.rotation.cos), squares = lanes::dot(turn, turn);
    if (!lanes::is_near_one(squares[0])) return false;
    const Double2 scale = lanes::approximate_inverse_root(squares), cos = lanes::first(turn),
                  sin = lanes::second(turn) * Double2{1, -1};
    const Double2 center = lanes::loaded(&circle.center.x), offset = center - lanes::loaded(&pose.position.x);
    const double radius = static_cast<double>(circle.radius);

    PolygonSoa soa;
    soa.view_rows(polygon.sides(), polygon.side_count());
    PointLocation place;
    const Near near = locate_point(soa, cos * offset + sin * lanes::swapped(offset), scale, margin + radius, place);
    if (near == Near::unclear || !(std::abs(place.gap) + radius < std::numeric_limits<double>::infinity()))
        return false;
    if (near == Near::beyond) return true;
    const Double2 out = (cos * scale) * place.normal - (sin * scale) * lanes::swapped(place.normal);
    static constexpr double towards_b[2] = {-1, 1};
    lanes::store(out * lanes::double2(towards_b[polygon_is_a ? 1 : 0]), &result.normal.x);
    result.depth = static_cast<float>(radius - place.gap);
    ContactPoint<2> point;
    lanes::store(center - out * lanes::double2(0.5 * (place.gap + radius)), &point.position.x);
    point.depth = result.depth;
    const std::uint32_t corner = polygon_is_a ? place.first << 8 : place.first;
    point.feature = corner & (0u - (place.first == place.second ? 1u : 0u));
    result.points.push_back(point);
    name_end_or_edge<2>({place.first, place.second, 0}, 0, polygon_is_a ? result.feature_a : result.feature_b);
    (polygon_is_a ? result.feature_b : result.feature_a).kind = FeatureKind::vertex;
    return true;
}

bool contact_of_placed_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, double margin, Cache* cache,
                                Contact<2>& result) {
    const auto query = [&](const PlacedPolygon& first, const PlacedPolygon& second) {
        SignedDistance<2> distance;
        Manifold<2> manifold;
        const PairAnswer2 answer = pair2_contact(first, second, margin, margin, cache, distance, manifold);
        if (answer != PairAnswer2::within) return answer == PairAnswer2::beyond;
        write(distance, manifold, result);
        name_features(distance, result);
        return true;
    };
    return query_polygons(a, b, query, false);
}

bool closest_of_placed_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result) {
    const auto query = [&](const PlacedPolygon& first, const PlacedPolygon& second) {
        SignedDistance<2> distance;
        if (pair2_distance(first, second, cache, distance) == PairAnswer2::unknown) return false;
        write(distance, result);
        name_features(distance, result);
        return true;
    };
    return query_polygons(a, b, query, false);
}

// Out of line, to keep the fast path small.

[[gnu::noinline]] void closest_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Closest<2>& result) {
    result = closest(convex_of(a), convex_of(b), options);
}
[[gnu::noinline]] void contact_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Contact<2>& result) {
    result = contact(convex_of(a), convex_of(b), options);
}

[[gnu::noinline]] bool contact_by_edges(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Contact<2>& result) {
    const double margin = static_cast<double>(options.margin);
    return (options.cache != nullptr && separated_by_cache(a, b, *options.cache, margin)) ||
           contact_polygons(a, b, margin, options.cache, result) ||
           contact_of_placed_polygons(a, b, margin, options.cache, result);
}

}  // namespace

template <>
Closest<2> closest(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    Closest<2> result;
    if (options.trace != nullptr)
        closest_of_views(a, b, options, result);
    else if (!closest_polygons(a, b, options.cache, result) && !closest_of_placed_polygons(a, b, options.cache, result))
        closest_of_views(a, b, options, result);
    return result;
}

template <>
Contact<2> contact(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    Contact<2> result;
    result.normal[0] = 1;
    if (options.trace == nullptr) {
        const bool polygon_is_a = a.kind == ShapeKind::polytope && b.kind == ShapeKind::ball;
        if ((polygon_is_a || (a.kind == ShapeKind::ball && b.kind == ShapeKind::polytope)) &&
            contact_with_circle(polygon_is_a ? a : b, polygon_is_a ? b : a, polygon_is_a,
                                static_cast<double>(options.margin), result))
            return result;
        if (contact_by_edges(a, b, options, result)) return result;
    }
    contact_of_views(a, b, options, result);
    return result;
}

}  // namespace abut
