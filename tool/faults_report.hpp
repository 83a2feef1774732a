#pragma once

// What `abut check` has to say of spawns, passages, duplicates and leaks.

#include "faults.hpp"
#include "written.hpp"

#include <string>
#include <vector>

namespace abut::tool {

/// For a person: a paragraph for each kind that there is, its findings in the order of importance.
template <int D>
std::string text_of(const LevelFaults<D>& faults, const LevelView<D>& level);

/// One line each of what was looked at and found.
template <int D>
std::string summary_of(const LevelFaults<D>& faults);

/// How many there are of each kind, for the last line: "2 spawns are blocked".
template <int D>
std::vector<std::string> verdicts_of(const LevelFaults<D>& faults);

/// The arrays "spawns", "gaps", "duplicates" and "leaks", and the number "spawn_points".
template <int D>
Json json_of(const LevelFaults<D>& faults, const LevelView<D>& level);

/// Leaves what an earlier report, as JSON, doesn't have, and counts the rest in `known`. The same thing is one that is
/// told of the same objects at the same place: within the gap's width or the leak's extent. How deep a spawn is in, or
/// how narrow a passage is, isn't compared. A report from before there were these has none.
template <int D>
void drop_known(LevelFaults<D>& faults, const LevelView<D>& level, const Json& baseline);

}  // namespace abut::tool
