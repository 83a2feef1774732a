#pragma once

// Plain shapes of the plane as outlines, from the shapes as they were given. For .cpp files.

#include <abut/convex/polygon_soa.hpp>
#include <abut/math/set_affine.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut {

inline Rigid2 place_of(const ShapeRef<2>& given) {
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
inline bool set_outline_of(const ShapeRef<2>& given, PlacedPolygon& outline) {
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
        outline.set_box(DVec<2>(given.as<Box2>().half));
    } else {
        const Polygon& polygon = given.as<Polygon>();
        if (polygon.sides() == nullptr) return false;
        outline.sides.view_rows(polygon.sides(), polygon.side_count());
    }
    return true;
}

/// Of any kind. False where it has none.
inline bool set_placed_polygon(const ShapeRef<2>& given, PlacedPolygon& outline) {
    switch (given.kind) {
        case ShapeKind::ball:
            return set_outline_of<ShapeKind::ball>(given, outline);
        case ShapeKind::capsule:
            return set_outline_of<ShapeKind::capsule>(given, outline);
        case ShapeKind::segment:
            return set_outline_of<ShapeKind::segment>(given, outline);
        case ShapeKind::triangle:
            return set_outline_of<ShapeKind::triangle>(given, outline);
        case ShapeKind::box:
            return set_outline_of<ShapeKind::box>(given, outline);
        default:
            return set_outline_of<ShapeKind::polytope>(given, outline);
    }
}

}  // namespace abut
