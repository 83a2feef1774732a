#pragma once

// Conversions to Box2D's shapes; polygons without their default radius. Included by files that use Box2D.

#include "../../scenes/convex_shapes.hpp"
#include "../box2d.hpp"

#include <memory>
#include <variant>
#include <vector>

#include <box2d/b2_circle_shape.h>
#include <box2d/b2_polygon_shape.h>

namespace abut::bench::box2d {

inline std::unique_ptr<b2Shape> shape_of(const Circle& circle) {
    auto result = std::make_unique<b2CircleShape>();
    result->m_radius = circle.radius;
    return result;
}
inline std::unique_ptr<b2Shape> shape_of(const Box2& box) {
    auto result = std::make_unique<b2PolygonShape>();
    result->SetAsBox(box.half.x, box.half.y);
    result->m_radius = 0;
    return result;
}
inline std::unique_ptr<b2Shape> shape_of(const Polygon& polygon) {
    std::vector<b2Vec2> points;
    for (const Vec2& point : polygon.points()) points.push_back(to_box2d(point));
    auto result = std::make_unique<b2PolygonShape>();
    result->Set(points.data(), static_cast<int32>(points.size()));
    result->m_radius = 0;
    return result;
}

inline std::vector<std::unique_ptr<b2Shape>> shapes_of(const std::vector<scenes::AnyConvex<2>>& all) {
    std::vector<std::unique_ptr<b2Shape>> result;
    for (const scenes::AnyConvex<2>& shape : all)
        result.push_back(std::visit([](const auto& s) { return shape_of(s); }, shape));
    return result;
}

}  // namespace abut::bench::box2d
