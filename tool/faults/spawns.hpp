#pragma once

// Checks the spawn points of a level.

#include "tool/faults/facet_tree.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// A vertical capsule with its lowest point at the spawn; a ball if its height is twice its radius, or there is no up.
struct Character {
    float radius = 0;
    float height = 0;
};

template <int D>
struct SpawnOptions {
    std::optional<Character> character = std::nullopt;  ///< default: a point
    std::optional<Vec<D>> up = std::nullopt;            ///< unit vector; none: the level is seen from above
    std::optional<float> allow = std::nullopt;  ///< depth that is ignored; default: 1e-3 of the smaller one's size
};

enum class SpawnFault : std::uint8_t {
    inside,     ///< the character, or the point, is inside an object
    beneath,    ///< the first surface above is seen from behind: it is below a ground, outside of the level
    no_ground,  ///< no surface is below it
};

template <int D>
struct SpawnFinding {
    std::size_t place = 0;  ///< index in LevelView::places
    SpawnFault fault = SpawnFault::inside;
    std::optional<std::size_t> object = std::nullopt;  ///< object that it is in (the deepest) or below
    float depth = 0;                                   ///< depth, for `inside`
    std::optional<Vec<D>> free = std::nullopt;         ///< a free position near by, if one was found
};

/// Places that match a glob pattern, by path, name or class.
template <int D>
std::vector<std::size_t> matching_places(const LevelView<D>& level, const std::string& pattern);

/// Places whose name or class contains "spawn", "player_start", "playerstart" or "player start", in any case. Groups,
/// which have such places below them, are left out, and in 2D points at the origin: they stand for the whole map.
template <int D>
std::vector<std::size_t> default_spawns(const LevelView<D>& level);

/// Numbers of the objects that are at or below no spawn. The others mark a spawn, and block nothing.
template <int D>
std::vector<std::size_t> obstacles_of(const LevelView<D>& level, const std::vector<std::size_t>& spawns);

/// Checks the spawns. One with an area is at fault if each of the places tried in it is; the fault of its middle is
/// reported. Characters stand on slopes up to 60
/// degrees: the penetration of the round end into a slope through its lowest point is ignored. Faults of the ground are
/// checked only if there is an up.
template <int D>
std::vector<SpawnFinding<D>> find_spawn_faults(const LevelView<D>& level, const std::vector<std::size_t>& spawns,
                                               const SpawnOptions<D>& options);

}  // namespace abut::tool
