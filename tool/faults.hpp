#pragma once

// What a level designer wants to know of a level as it stands at its first moment, besides what touches: spawns,
// passages, duplicates and leaks.

#include "check.hpp"
#include "duplicates.hpp"
#include "gaps.hpp"
#include "leaks.hpp"
#include "spawns.hpp"
#include <abut/math/result.hpp>

#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// Which way is up: an axis and its sign, or none, as for a map seen from above.
struct UpDirection {
    int axis = 1;  ///< 0, 1, 2; below 0: none
    float sign = 1;
};

/// From which width on passages count, and up to which.
struct GapRange {
    float least = 0, width = 0;
};

/// What of a character's width is a seam and no passage, where nobody says it.
inline constexpr float default_least_gap = 0.1f;

struct FaultOptions {
    std::vector<std::string> spawns = {};  ///< patterns for places; none: usual names
    std::optional<Character> character = {};
    std::optional<UpDirection> up = {};    ///< by default y in space, none in the plane
    std::optional<GapRange> gap = {};      ///< by default from the character's width; without either, no gaps
    std::vector<std::string> closed = {};  ///< patterns for objects; none: small holes of all
    std::optional<float> allow = {};
    std::vector<PairPattern> pairs = {};  ///< only gaps and copies between these, and nothing that isn't asked for
};

template <int D>
struct LevelFaults {
    std::vector<SpawnFinding<D>> spawns;
    std::size_t spawns_looked_at = 0;
    std::vector<Gap<D>> gaps;
    std::optional<GapRange> gap_range;  ///< what was looked for; none: nothing
    Duplicates<D> duplicates;
    std::vector<LevelLeak> leaks;
    std::size_t known = 0;  ///< left out because a baseline has them

    std::size_t count() const {
        return spawns.size() + gaps.size() + duplicates.groups.size() + duplicates.facets.size() + leaks.size();
    }
};

/// The passages that are looked for: what was asked for, or what a character needs.
std::optional<GapRange> gap_range(const FaultOptions& options);

/// A Problem where a pattern describes nothing, or where an up is asked for that the space doesn't have; its message
/// begins with the option. Leaks are looked for in space alone.
template <int D>
Result<LevelFaults<D>> find_faults(const LevelView<D>& level, const FaultOptions& options);

}  // namespace abut::tool
