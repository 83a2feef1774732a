#pragma once

// Which objects of a 2D level collide. Maps also draw pictures, and mark zones.

#include <abut/io/level.hpp>
#include <abut/math/result.hpp>

#include <string>
#include <vector>

namespace abut::tool {

struct SolidObjects {
    std::vector<bool> solid;   ///< per object of the level
    std::vector<bool> ground;  ///< those of them that are the level itself: tile layers, and what says that it collides
    std::string note;          ///< what was left out, in one line; empty: nothing
};

/// Objects that match a glob pattern, by their path, name or class or by a layer above them. Without patterns, the
/// first of these that holds:
/// - If an object, its layer, its class or a property says "collision", "solid", ..., then all of those, and tile
///   layers whose tiles have collision shapes.
/// - If tiles have no collision shapes: layers of walls or obstacles; or the only tile layer; or no tile layer.
///   Objects collide, but not zones: "trigger", "spawn", "warp", ...
/// A property with such a name and the value "false" says that an object doesn't collide.
/// Returns a Problem for a pattern without a match; its message begins with the option.
Result<SolidObjects> solid_objects(const Level& level, const std::vector<std::string>& patterns);

}  // namespace abut::tool
