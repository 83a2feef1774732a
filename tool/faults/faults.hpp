#pragma once

// Faults of a level at its first time, besides contacts: spawns, passages, duplicates, leaks and floating objects.

#include "tool/check/check.hpp"
#include "tool/check/severities.hpp"
#include "tool/faults/duplicates.hpp"
#include "tool/faults/floating.hpp"
#include "tool/faults/gaps.hpp"
#include "tool/faults/leaks.hpp"
#include "tool/faults/spawns.hpp"
#include <abut/math/result.hpp>

#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// The up direction: a signed axis, or none for a level seen from above.
struct UpDirection {
    int axis = 1;  ///< 0, 1, 2; negative: none
    float sign = 1;
};

/// The range of widths of passages that are reported.
struct GapRange {
    float min_width = 0, width = 0;
};

/// Default of the minimum width, relative to the maximum: narrower gaps are seams and no passages.
inline constexpr float default_min_gap = 0.1f;

struct FaultOptions {
    std::vector<std::string> spawns = {};  ///< glob patterns for places; empty: default names
    std::optional<Character> character = {};
    std::optional<UpDirection> up = {};  ///< default: y in 3D, none in 2D
    std::optional<GapRange> gap =
        {};  ///< default: from the character's width; without a character, gaps are not checked
    std::vector<std::string> closed = {};  ///< glob patterns for objects; empty: small holes of all objects
    std::optional<float> allow = {};
    std::vector<PairPattern> pairs =
        {};  ///< only gaps and duplicates between these pairs, and checks selected explicitly
};

template <int D>
struct LevelFaults {
    std::vector<SpawnFinding<D>> spawns;
    std::size_t spawns_tested = 0;
    std::vector<Gap<D>> gaps;
    std::optional<GapRange> gap_range;  ///< the range that was checked; none: not checked
    Duplicates<D> duplicates;
    std::vector<LevelLeak> leaks;
    std::vector<FloatingObject<D>> floating;
    std::vector<std::string> notes;
};

/// The range of widths given, or the one that the character needs.
std::optional<GapRange> gap_range(const FaultOptions& options);

/// Finds all faults of kinds that are not off. Returns a Problem if a pattern matches nothing, or the up axis doesn't
/// exist in 2D; its message begins with the option. Leaks are checked in 3D only.
template <int D>
Result<LevelFaults<D>> find_faults(const LevelView<D>& level, const FaultOptions& options,
                                   const Severities& severities);

}  // namespace abut::tool
