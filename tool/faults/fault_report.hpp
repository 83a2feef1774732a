#pragma once

// Faults of a level as findings of a report.

#include "tool/check/finding.hpp"
#include "tool/check/severities.hpp"
#include "tool/faults/faults.hpp"

#include <string>
#include <vector>

namespace abut::tool {

/// All faults. Rules that are off are left out.
template <int D>
std::vector<Finding> findings_of(const LevelFaults<D>& faults, const LevelView<D>& level, const Severities& severities);

}  // namespace abut::tool
