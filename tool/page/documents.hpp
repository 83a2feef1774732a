#pragma once

// The files that show findings in their places: the page of --report and the picture of --svg.

#include "tool/check/finding.hpp"
#include "tool/check/settings.hpp"
#include "tool/objects/level_view.hpp"
#include <abut/io/level.hpp>
#include <abut/io/scene.hpp>

#include <vector>

namespace abut::tool {

/// Makes what the plan wants. The objects may be at any time; the level is as at the first one.
void add_documents(FileReport& report, const CheckPlan& plan, const Scene& scene, const SceneObjects& objects,
                   const std::vector<double>& times, const LevelView<3>& level);
void add_documents(FileReport& report, const CheckPlan& plan, const Level& file, const LevelObjects& objects,
                   const std::vector<double>& times, const LevelView<2>& level);

}  // namespace abut::tool
