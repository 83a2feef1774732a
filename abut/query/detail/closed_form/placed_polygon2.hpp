#pragma once

// Plain shapes of the plane as placed polygons, without views of them. For .cpp files.

#include <abut/convex/polygon_soa.hpp>
#include <abut/math/detail/set_affine.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut::detail {

inline Rigid2 place_of(const ShapeRef<2>& given) {
    return given.pose != nullptr ? rigid(*given.pose) : Rigid2{1, 0, 0, 0};
}

/// Places a box like `convex(box, pose)`.
inline Rigid2 place_of_box(const Box2& box, const Pose2* pose) {
    if (pose == nullptr) return rigid({box.center, box.rotation});
    const Affine<2> place = convex(box, *pose).place;
    return {place.column[0].x, place.column[0].y, place.offset.x, place.offset.y};
}

/// For one kind, so that the code behind can be compiled for that kind.
template <ShapeKind kind>
inline bool set_placed_polygon_of(const ShapeRef<2>& given, PlacedPolygon& polygon) {
    if constexpr (kind != ShapeKind::box && kind != ShapeKind::ball) polygon.place = place_of(given);
    polygon.radius = 0;
    if constexpr (kind == ShapeKind::ball) {
        const Circle& circle = given.as<Circle>();
        polygon.radius = static_cast<double>(circle.radius);
        polygon.set_point(place_of(given).point(DVec<2>(circle.center)));
    } else if constexpr (kind == ShapeKind::capsule) {
        const Capsule2& capsule = given.as<Capsule2>();
        polygon.radius = static_cast<double>(capsule.radius);
        return polygon.set_segment(capsule.a, capsule.b);
    } else if constexpr (kind == ShapeKind::segment) {
        const Segment2& segment = given.as<Segment2>();
        return polygon.set_segment(segment.a, segment.b);
    } else if constexpr (kind == ShapeKind::triangle) {
        const Triangle2& triangle = given.as<Triangle2>();
        return polygon.set_triangle(triangle.a, triangle.b, triangle.c);
    } else if constexpr (kind == ShapeKind::box) {
        polygon.place = place_of_box(given.as<Box2>(), given.pose);
        polygon.set_box(DVec<2>(given.as<Box2>().half));
    } else {
        const Polygon& own = given.as<Polygon>();
        if (own.sides() == nullptr) return false;
        polygon.sides.view_rows(own.sides(), own.side_count());
    }
    return true;
}

/// For any kind. Returns false for a shape that is no polygon of few edges.
inline bool set_placed_polygon(const ShapeRef<2>& given, PlacedPolygon& polygon) {
    switch (given.kind) {
        case ShapeKind::ball:
            return set_placed_polygon_of<ShapeKind::ball>(given, polygon);
        case ShapeKind::capsule:
            return set_placed_polygon_of<ShapeKind::capsule>(given, polygon);
        case ShapeKind::segment:
            return set_placed_polygon_of<ShapeKind::segment>(given, polygon);
        case ShapeKind::triangle:
            return set_placed_polygon_of<ShapeKind::triangle>(given, polygon);
        case ShapeKind::box:
            return set_placed_polygon_of<ShapeKind::box>(given, polygon);
        default:
            return set_placed_polygon_of<ShapeKind::polytope>(given, polygon);
    }
}

}  // namespace abut::detail
