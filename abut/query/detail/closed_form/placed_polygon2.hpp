#pragma once

// Plain shapes of the plane as placed polygons, without views of them. For .cpp files.

#include <abut/convex/pairs/placed_polygon2.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut::detail {

inline void set_placed_segment(const Vec2& from, const Vec2& to, const Pose2* pose, PlacedPolygon& polygon) {
    const Double2 a = lanes::loaded(&from.x), b = lanes::loaded(&to.x), middle = (a + b) * Double2{0.5, 0.5};
    if (pose == nullptr) return polygon.set_segment(middle, b - a);
    const LanePose place = lane_pose(*pose);
    polygon.set_segment(place.point(middle), place.vector(b - a));
}

/// Returns false for a polygon of many edges.
inline bool set_placed_polytope(const ShapeRef<2>& given, PlacedPolygon& polygon) {
    const Polygon& own = given.as<Polygon>();
    polygon.radius = 0;
    if (own.sides() == nullptr) return false;
    polygon.place = lane_pose(pose_or_none(given.pose));
    polygon.set_rows(own.sides(), own.side_count());
    return true;
}

/// Other shapes than polytopes.
inline bool set_placed_primitive(const ShapeRef<2>& given, PlacedPolygon& polygon) {
    polygon.radius = 0;
    switch (given.kind) {
        case ShapeKind::ball: {
            const Circle& circle = given.as<Circle>();
            const Double2 center = lanes::loaded(&circle.center.x);
            polygon.radius = static_cast<double>(circle.radius);
            polygon.set_point(given.pose == nullptr ? center : lane_pose(*given.pose).point(center));
            return true;
        }
        case ShapeKind::capsule: {
            const Capsule2& capsule = given.as<Capsule2>();
            set_placed_segment(capsule.a, capsule.b, given.pose, polygon);
            polygon.radius = static_cast<double>(capsule.radius);
            return true;
        }
        case ShapeKind::segment:
            set_placed_segment(given.as<Segment2>().a, given.as<Segment2>().b, given.pose, polygon);
            return true;
        case ShapeKind::triangle: {
            const Triangle2& triangle = given.as<Triangle2>();
            polygon.place = lane_pose(pose_or_none(given.pose));
            return polygon.set_triangle(triangle.a, triangle.b, triangle.c);
        }
        case ShapeKind::box: {
            const Box2& box = given.as<Box2>();
            polygon.place.position = lanes::loaded(&box.center.x);
            Double2 turn = unit_turn(box.rotation);
            if (given.pose != nullptr) {
                const LanePose place = lane_pose(*given.pose);
                polygon.place.position = place.point(polygon.place.position);
                turn = place.vector(turn);
            }
            polygon.place.set_turn(turn);
            polygon.set_box(lanes::loaded(&box.half.x));
            return true;
        }
        case ShapeKind::polytope:
            break;
    }
    return false;
}

/// Returns false for a shape that is no polygon of few edges.
[[gnu::always_inline]] inline bool set_placed_polygon(const ShapeRef<2>& given, PlacedPolygon& polygon) {
    return given.kind == ShapeKind::polytope ? set_placed_polytope(given, polygon)
                                             : set_placed_primitive(given, polygon);
}

}  // namespace abut::detail
