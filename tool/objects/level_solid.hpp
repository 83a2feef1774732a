#pragma once

// The union of a level's objects as one shape, without the internal edges between its parts.

#include <abut/io/level.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/compound.hpp>

#include <cstddef>
#include <optional>

namespace abut::tool {

/// Its parts are the boundary segments of filled objects, and lines. Its interior is that of the objects. `closest`
/// therefore returns the signed distance to the boundary of the union.
struct LevelSolid {
    Compound2 boundary;              ///< boundary segments
    std::optional<Compound2> areas;  ///< objects with an interior
};

/// Returns a Problem if the level has no object. The message doesn't begin with the file.
Result<LevelSolid> level_solid(const Level& level);

Aabb2 bounds(const LevelSolid& solid);
void each_part(const LevelSolid& solid, const Aabb2& box, detail::PartVisitor<2> visit);
void each_part_along(const LevelSolid& solid, const MovingBox<2>& box, detail::PartReachVisitor<2> visit);
void each_part_near(const LevelSolid& solid, const Aabb2& box, detail::PartReachVisitor<2> visit);
bool solid_contains(const LevelSolid& solid, const Vec2& point);

}  // namespace abut::tool
