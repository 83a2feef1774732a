#pragma once

// A picture of a scene with its findings.

#include "tool/check/finding.hpp"
#include "tool/objects/level_view.hpp"

#include <string>

namespace abut::tool {

/// An SVG document: all objects at the first time, those of findings in colour, and a mark with the code at each
/// finding. In 3D seen from the front and above; `up` is a unit vector. In 2D y points down.
std::string scene_picture(const FileReport& report, const LevelView<3>& level, const Vec3& up);
std::string scene_picture(const FileReport& report, const LevelView<2>& level);

}  // namespace abut::tool
