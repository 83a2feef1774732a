#pragma once

// All of a level as one shape whose surface is what bounds it, without the seams between its parts.

#include <abut/io/level.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/compound.hpp>

#include <cstddef>
#include <optional>

namespace abut::tool {

/// Its parts are the segments around what is filled, and lines; solid where an object is. What `closest` tells of a
/// point is then the distance to the border of the union, inside as well.
struct LevelSolid {
    Compound2 border;                ///< segments
    std::optional<Compound2> areas;  ///< objects that have an inside
};

/// A Problem where the level has no object; its message doesn't begin with the file.
Result<LevelSolid> level_solid(const Level& level);

Aabb2 bounds(const LevelSolid& solid);
void each_part(const LevelSolid& solid, const Aabb2& box, PartVisitor<2> visit);
void each_part_along(const LevelSolid& solid, const MovingBox<2>& box, PartReachVisitor<2> visit);
void each_part_near(const LevelSolid& solid, const Aabb2& box, PartReachVisitor<2> visit);
bool solid_contains(const LevelSolid& solid, const Vec2& point);

}  // namespace abut::tool
