#include <abut/convex/pairs/pair2.hpp>
#include <abut/convex/pairs/point2.hpp>
#include <abut/query/direct.hpp>
#include <abut/query/given_outline.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/polygons2.hpp>
#include <abut/query/write_answer.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/polygon.hpp>

namespace abut {
namespace {

/// A sum is finite only where all its terms are; the rest of an outline follows from these.
inline double sum_of(const PlacedPolygon& outline, ShapeKind kind) {
    const Rigid2& place = outline.place;
    const double placed = (place.x + place.y) + (place.cos + place.sin);
    if (kind == ShapeKind::ball) return placed + outline.radius;
    // A polygon is finite since it was built.
    return kind == ShapeKind::polytope ? placed : placed + (outline.radius + outline.sides.size + outline.sides.area);
}

/// ask(outline of a, outline of b), where both have one and all their numbers are finite; else `otherwise`. What is
/// asked of two polygons or two boxes is compiled for those.
template <class Ask, class Answer, class Set>
inline Answer ask_of(const ShapeRef<2>& a, const ShapeRef<2>& b, const Ask& ask, Answer otherwise, const Set& set) {
    PlacedPolygon first, second;
    const bool known = set(a, first) && set(b, second) && std::isfinite(sum_of(first, a.kind) + sum_of(second, b.kind));
    return known ? ask(first, second) : otherwise;
}
template <class Ask, class Answer>
Answer ask_of_outlines(const ShapeRef<2>& a, const ShapeRef<2>& b, const Ask& ask, Answer otherwise) {
    if (a.kind == b.kind && a.kind == ShapeKind::polytope)
        return ask_of(a, b, ask, otherwise, set_outline_of<ShapeKind::polytope>);
    if (a.kind == b.kind && a.kind == ShapeKind::box)
        return ask_of(a, b, ask, otherwise, set_outline_of<ShapeKind::box>);
    return ask_of(a, b, ask, otherwise,
                  [](const ShapeRef<2>& given, PlacedPolygon& outline) { return set_placed_polygon(given, outline); });
}

template <class Answer>
void name_features(const SignedDistance<2>& distance, Answer& answer) {
    name_end_or_edge<2>(distance.corners.a, 0, answer.feature_a);
    name_end_or_edge<2>(distance.corners.b, 0, answer.feature_b);
}

}  // namespace

DirectAnswer direct_overlap(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache) {
    if (cache != nullptr && parted_again(a, b, *cache, 0)) return DirectAnswer::no;
    const DirectAnswer of_polygons = overlap_polygons(a, b, cache);
    if (of_polygons != DirectAnswer::unknown) return of_polygons;
    const auto ask = [&](const PlacedPolygon& first, const PlacedPolygon& second) {
        const PairAnswer2 answer = pair2_within(first, second, 0, cache);
        return answer == PairAnswer2::unknown  ? DirectAnswer::unknown
               : answer == PairAnswer2::within ? DirectAnswer::yes
                                               : DirectAnswer::no;
    };
    return ask_of_outlines(a, b, ask, DirectAnswer::unknown);
}

namespace {

/// A circle and a polygon, from first to last in one piece: `pair2_contact` with nothing but what these two need.
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

    PolygonSoa sides;
    sides.view_rows(polygon.sides(), polygon.side_count());
    PointLocation place;
    const Near near = locate_point(sides, cos * offset + sin * lanes::swapped(offset), scale, margin + radius, place);
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

bool contact_of_outlines(const ShapeRef<2>& a, const ShapeRef<2>& b, double margin, Cache* cache, Contact<2>& result) {
    const auto ask = [&](const PlacedPolygon& first, const PlacedPolygon& second) {
        SignedDistance<2> distance;
        Manifold<2> manifold;
        const PairAnswer2 answer = pair2_contact(first, second, margin, margin, cache, distance, manifold);
        if (answer != PairAnswer2::within) return answer == PairAnswer2::beyond;
        write(distance, manifold, result);
        name_features(distance, result);
        return true;
    };
    return ask_of_outlines(a, b, ask, false);
}

bool closest_of_outlines(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result) {
    const auto ask = [&](const PlacedPolygon& first, const PlacedPolygon& second) {
        SignedDistance<2> distance;
        if (pair2_distance(first, second, cache, distance) == PairAnswer2::unknown) return false;
        write(distance, result);
        name_features(distance, result);
        return true;
    };
    return ask_of_outlines(a, b, ask, false);
}

// Kept out of what is hot, where they would take up room.

[[gnu::noinline]] void closest_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Closest<2>& result) {
    result = closest(convex_of(a), convex_of(b), options);
}
[[gnu::noinline]] void contact_of_views(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Contact<2>& result) {
    result = contact(convex_of(a), convex_of(b), options);
}

[[gnu::noinline]] bool contact_of_sides(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options,
                                        Contact<2>& result) {
    const double margin = static_cast<double>(options.margin);
    return (options.cache != nullptr && parted_again(a, b, *options.cache, margin)) ||
           contact_polygons(a, b, margin, options.cache, result) ||
           contact_of_outlines(a, b, margin, options.cache, result);
}

}  // namespace

template <>
Closest<2> closest(const ShapeRef<2>& a, const ShapeRef<2>& b, const QueryOptions<2>& options) {
    Closest<2> result;
    if (options.trace != nullptr)
        closest_of_views(a, b, options, result);
    else if (!closest_polygons(a, b, options.cache, result) && !closest_of_outlines(a, b, options.cache, result))
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
        if (contact_of_sides(a, b, options, result)) return result;
    }
    contact_of_views(a, b, options, result);
    return result;
}

}  // namespace abut
