#pragma once

// Bodies: sets of objects that belong together, so that contacts between them are no findings.

#include "tool/objects/level_objects.hpp"
#include "tool/objects/scene_objects.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace abut::tool {

/// One number per object, equal for those of one body. A body is what is at or below a rigid body, a skinned character,
/// or a node that matches a glob pattern by its path or name; the nearest one above an object counts. Returns a Problem
/// for a pattern without a match; its message begins with the option.
Result<std::vector<std::uint32_t>> bodies_of(const Scene& scene, const SceneObjects& objects,
                                             const std::vector<std::string>& patterns);

/// In a level the ground is one body, by the flags per object of the level; and what is at or below a layer or an
/// object that matches a pattern.
Result<std::vector<std::uint32_t>> bodies_of(const Level& level, const LevelObjects& objects,
                                             const std::vector<bool>& ground, const std::vector<std::string>& patterns);

}  // namespace abut::tool
