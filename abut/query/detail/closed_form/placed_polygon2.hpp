#pragma once

// Plain shapes of the plane as placed polygons, without views of them. For .cpp files.

#include <abut/convex/pairs/point2.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut::detail {

/// A circle about the origin of its frame, as most are, doesn't wait for the rotation.
[[gnu::always_inline]] inline Double2 placed_center(const ShapeRef<2>& circle) {
    const Double2 center = lanes::loaded(&circle.as<Circle>().center.x);
    if (circle.pose == nullptr) return center;
    const Double2 turn = lanes::loaded(&circle.pose->rotation.cos), position = lanes::loaded(&circle.pose->position.x);
    if (lanes::bits(center == Double2{0, 0}) == 3 && lanes::is_near_one(lanes::dot(turn, turn)[0])) return position;
    return lane_pose(*circle.pose).point(center);
}

inline void set_placed_circle(const ShapeRef<2>& given, PlacedPolygon& point) {
    point.radius = static_cast<double>(given.as<Circle>().radius);
    point.set_point(placed_center(given));
}

inline void set_placed_segment(const Vec2& from, const Vec2& to, const Pose2* pose, PlacedPolygon& segment) {
    const Double2 a = lanes::loaded(&from.x), b = lanes::loaded(&to.x), middle = (a + b) * Double2{0.5, 0.5};
    if (pose == nullptr) return segment.set_segment(middle, b - a);
    const LanePose place = lane_pose(*pose);
    segment.set_segment(place.point(middle), place.vector(b - a));
}
inline void set_placed_capsule(const ShapeRef<2>& given, PlacedPolygon& segment) {
    const Capsule2& capsule = given.as<Capsule2>();
    set_placed_segment(capsule.a, capsule.b, given.pose, segment);
    segment.radius = static_cast<double>(capsule.radius);
}

[[gnu::always_inline]] inline void set_placed_box(const ShapeRef<2>& given, PlacedPolygon& polygon) {
    const Box2& box = given.as<Box2>();
    polygon.radius = 0;
    polygon.place.position = lanes::loaded(&box.center.x);
    Double2 turn = unit_turn(box.rotation);
    if (given.pose != nullptr) {
        const LanePose place = lane_pose(*given.pose);
        polygon.place.position = place.point(polygon.place.position);
        turn = place.vector(turn);
    }
    polygon.place.set_turn(turn);
    polygon.set_box(lanes::loaded(&box.half.x));
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
    switch (given.kind) {
        case ShapeKind::ball:
            set_placed_circle(given, polygon);
            return true;
        case ShapeKind::capsule:
            set_placed_capsule(given, polygon);
            return true;
        case ShapeKind::segment:
            set_placed_segment(given.as<Segment2>().a, given.as<Segment2>().b, given.pose, polygon);
            polygon.radius = 0;
            return true;
        case ShapeKind::triangle: {
            const Triangle2& triangle = given.as<Triangle2>();
            polygon.radius = 0;
            polygon.place = lane_pose(pose_or_none(given.pose));
            return polygon.set_triangle(triangle.a, triangle.b, triangle.c);
        }
        case ShapeKind::box:
            set_placed_box(given, polygon);
            return true;
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

/// Calls query(core, the point in the core's frame) with the core of a shape of this kind. Each kind has code of its
/// own, in which the numbers of the core stay in registers.
template <ShapeKind kind, class Query>
[[gnu::always_inline]] inline PairAnswer with_core(const ShapeRef<2>& given, Double2 point, const Query& query) {
    PlacedPolygon shape;
    if constexpr (kind == ShapeKind::polytope) {
        const Polygon& own = given.as<Polygon>();
        if (own.sides() == nullptr) return PairAnswer::unknown;
        const Pose2& pose = pose_or_none(given.pose);
        const ScaledTurn turn(pose.rotation);
        shape.radius = 0;
        shape.place.position = lanes::loaded(&pose.position.x);
        shape.place.set_turn(turn.turn);
        const Double2 local = shape.place.back(point - shape.place.position);
        shape.place.set_turn(turn.unit_turn());
        shape.set_rows(own.sides(), own.side_count());
        return query(ListedCore(shape), ScaledPoint{local, turn.scale});
    } else if constexpr (kind == ShapeKind::ball) {
        set_placed_circle(given, shape);
        return query(PointCore(shape), ScaledPoint{});
    } else if constexpr (kind == ShapeKind::box) {
        set_placed_box(given, shape);
        return query(BoxCore(shape), seen_from(shape, point));
    } else {
        if (!set_placed_primitive(given, shape)) return PairAnswer::unknown;
        return with_core(shape, point, query);
    }
}

}  // namespace abut::detail
