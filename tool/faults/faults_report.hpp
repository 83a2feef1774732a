#pragma once

// The reports of spawns, gaps, duplicates and leaks.

#include "tool/faults/faults.hpp"
#include "tool/shared/format.hpp"

#include <string>
#include <vector>

namespace abut::tool {

/// Text for people: a paragraph per kind of fault, the worst ones first.
template <int D>
std::string text_of(const LevelFaults<D>& faults, const LevelView<D>& level);

/// One line per check that was made.
template <int D>
std::string summary_of(const LevelFaults<D>& faults);

/// The count of each kind for the last line: "2 spawns are blocked".
template <int D>
std::vector<std::string> verdicts_of(const LevelFaults<D>& faults);

/// The arrays "spawns", "gaps", "duplicates" and "leaks", and the number "spawn_points".
template <int D>
Json json_of(const LevelFaults<D>& faults, const LevelView<D>& level);

/// Removes faults that the baseline, a JSON report, has, and adds their count to `known`. Faults are equal if they are
/// about the same objects and at the same position, to within the gap's width or the leak's extent. Depths and widths
/// are not compared. Reports of versions without these arrays have no faults.
template <int D>
void remove_known(LevelFaults<D>& faults, const LevelView<D>& level, const Json& baseline);

}  // namespace abut::tool
