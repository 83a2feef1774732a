#include <abut/convex/plane_pair.hpp>
#include <abut/convex/plane_point.hpp>
#include <abut/math/set_affine.hpp>
#include <abut/query/direct.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/write_answer.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut {
namespace {

inline Rigid2 place_of(const Given<2>& given) {
    return given.pose != nullptr ? rigid(*given.pose) : Rigid2{1, 0, 0, 0};
}

/// As `convex(box, pose)` places it.
inline Rigid2 place_of_box(const Box2& box, const Pose2* pose) {
    if (pose == nullptr) return rigid({box.center, box.rotation});
    const Affine<2> place = convex(box, *pose).place;
    return {place.column[0].x, place.column[0].y, place.offset.x, place.offset.y};
}

/// Of one kind, so that what is asked of it can be compiled for that kind.
template <ShapeKind kind>
inline bool set_outline(const Given<2>& given, Outline& outline) {
    if constexpr (kind != ShapeKind::box && kind != ShapeKind::ball) outline.place = place_of(given);
    outline.radius = 0;
    if constexpr (kind == ShapeKind::ball) {
        const Circle& circle = given.as<Circle>();
        outline.radius = static_cast<double>(circle.radius);
        outline.set_point(place_of(given).point(DVec<2>(circle.center)));
    } else if constexpr (kind == ShapeKind::capsule) {
        const Capsule2& capsule = given.as<Capsule2>();
        outline.radius = static_cast<double>(capsule.radius);
        return outline.set_segment(capsule.a, capsule.b);
    } else if constexpr (kind == ShapeKind::segment) {
        const Segment2& segment = given.as<Segment2>();
        return outline.set_segment(segment.a, segment.b);
    } else if constexpr (kind == ShapeKind::triangle) {
        const Triangle2& triangle = given.as<Triangle2>();
        return outline.set_triangle(triangle.a, triangle.b, triangle.c);
    } else if constexpr (kind == ShapeKind::box) {
        outline.place = place_of_box(given.as<Box2>(), given.pose);
        outline.set_box(given.as<Box2>().half);
    } else {
        const Polygon& polygon = given.as<Polygon>();
        if (polygon.sides() == nullptr) return false;
        outline.sides.refer_to(polygon.sides(), polygon.side_count());
    }
    return true;
}

bool set_outline(const Given<2>& given, Outline& outline) {
    switch (given.kind) {
        case ShapeKind::ball:
            return set_outline<ShapeKind::ball>(given, outline);
        case ShapeKind::capsule:
            return set_outline<ShapeKind::capsule>(given, outline);
        case ShapeKind::segment:
            return set_outline<ShapeKind::segment>(given, outline);
        case ShapeKind::triangle:
            return set_outline<ShapeKind::triangle>(given, outline);
        case ShapeKind::box:
            return set_outline<ShapeKind::box>(given, outline);
        default:
            return set_outline<ShapeKind::polytope>(given, outline);
    }
}

/// A sum is finite only where all its terms are; the rest of an outline follows from these.
inline double sum_of(const Outline& outline, ShapeKind kind) {
    const Rigid2& place = outline.place;
    const double placed = (place.x + place.y) + (place.cos + place.sin);
    if (kind == ShapeKind::ball) return placed + outline.radius;
    // A polygon is finite since it was built.
    return kind == ShapeKind::polytope ? placed : placed + (outline.radius + outline.sides.size + outline.sides.area);
}

/// ask(outline of a, outline of b), where both have one and all their numbers are finite; else `otherwise`. What is
/// asked of two polygons or two boxes is compiled for those.
template <class Ask, class Answer, class Set>
inline Answer ask_of(const Given<2>& a, const Given<2>& b, const Ask& ask, Answer otherwise, const Set& set) {
    Outline first, second;
    const bool known = set(a, first) && set(b, second) && std::isfinite(sum_of(first, a.kind) + sum_of(second, b.kind));
    return known ? ask(first, second) : otherwise;
}
template <class Ask, class Answer>
Answer ask_of_outlines(const Given<2>& a, const Given<2>& b, const Ask& ask, Answer otherwise) {
    if (a.kind == b.kind && a.kind == ShapeKind::polytope)
        return ask_of(a, b, ask, otherwise, set_outline<ShapeKind::polytope>);
    if (a.kind == b.kind && a.kind == ShapeKind::box) return ask_of(a, b, ask, otherwise, set_outline<ShapeKind::box>);
    return ask_of(a, b, ask, otherwise,
                  [](const Given<2>& given, Outline& outline) { return set_outline(given, outline); });
}

template <class Answer>
void name_features(const SignedDistance<2>& distance, Answer& answer) {
    name_end_or_edge<2>(distance.corners.a, 0, answer.feature_a);
    name_end_or_edge<2>(distance.corners.b, 0, answer.feature_b);
}

}  // namespace

DirectAnswer direct_overlap(const Given<2>& a, const Given<2>& b, Cache* cache) {
    const auto ask = [&](const Outline& first, const Outline& second) {
        const PlaneAnswer answer = plane_near(first, second, 0, cache);
        return answer == PlaneAnswer::unknown  ? DirectAnswer::unknown
               : answer == PlaneAnswer::within ? DirectAnswer::yes
                                               : DirectAnswer::no;
    };
    return ask_of_outlines(a, b, ask, DirectAnswer::unknown);
}

bool direct_closest(const Given<2>& a, const Given<2>& b, Cache* cache, Closest<2>& result) {
    const auto ask = [&](const Outline& first, const Outline& second) {
        SignedDistance<2> distance;
        if (plane_distance(first, second, cache, distance) == PlaneAnswer::unknown) return false;
        write(distance, result);
        name_features(distance, result);
        return true;
    };
    return ask_of_outlines(a, b, ask, false);
}

namespace {

/// A circle and a polygon, from first to last in one piece: `plane_contact` with nothing but what these two need.
template <bool polygon_is_a>
bool contact_with_circle(const Given<2>& of_polygon, const Given<2>& of_circle, double margin, Contact<2>& result) {
    const Polygon& polygon = of_polygon.as<Polygon>();
    const Circle& circle = of_circle.as<Circle>();
    if (polygon.sides() == nullptr || of_circle.pose != nullptr) return false;
    const double radius = static_cast<double>(circle.radius);
    const DVec<2> center(circle.center);
    const Rigid2 frame = place_of(of_polygon);
    const DVec<2> seen = frame.unplaced(center);
    if (!std::isfinite(seen.x + seen.y + radius)) return false;

    Sides sides;
    sides.refer_to(polygon.sides(), polygon.side_count());
    PlaceOfPoint place;
    if (!find_place(sides, seen, margin + radius, place)) return true;
    const DVec<2> out = frame.vector(place.normal);
    const double distance = place.gap - radius;
    const DVec<2> normal = polygon_is_a ? out : -out;
    const DVec<2> on_a = polygon_is_a ? frame.point(place.on) : center - out * radius;
    result.normal = to_float(normal);
    result.depth = static_cast<float>(-distance);
    const std::uint32_t corner = polygon_is_a ? place.first << 8 : place.first;
    result.points.push_back({to_float(on_a + normal * (0.5 * distance)), result.depth,
                             corner & (0u - (place.first == place.second ? 1u : 0u))});
    name_end_or_edge<2>({place.first, place.second, 0}, 0, polygon_is_a ? result.feature_a : result.feature_b);
    (polygon_is_a ? result.feature_b : result.feature_a).kind = FeatureKind::vertex;
    return true;
}

}  // namespace

bool direct_contact(const Given<2>& a, const Given<2>& b, double margin, Cache* cache, Contact<2>& result) {
    if (a.kind == ShapeKind::polytope && b.kind == ShapeKind::ball) {
        if (contact_with_circle<true>(a, b, margin, result)) return true;
    } else if (a.kind == ShapeKind::ball && b.kind == ShapeKind::polytope) {
        if (contact_with_circle<false>(b, a, margin, result)) return true;
    }
    const auto ask = [&](const Outline& first, const Outline& second) {
        SignedDistance<2> distance;
        Manifold<2> manifold;
        const PlaneAnswer answer = plane_contact(first, second, margin, margin, cache, distance, manifold);
        if (answer != PlaneAnswer::within) return answer == PlaneAnswer::beyond;
        write(distance, manifold, result);
        name_features(distance, result);
        return true;
    };
    return ask_of_outlines(a, b, ask, false);
}

}  // namespace abut
