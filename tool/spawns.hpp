#pragma once

// Places where characters enter a level, and whether they can.

#include "facet_tree.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace abut::tool {

/// A standing capsule, its lowest point at the spawn; a ball where its height is twice its radius or there is no up.
struct Character {
    float radius = 0;
    float height = 0;
};

template <int D>
struct SpawnOptions {
    std::optional<Character> character = std::nullopt;  ///< none: a point
    std::optional<Vec<D>> up = std::nullopt;            ///< of length 1; none: the level is seen from above
    std::optional<float> allow = std::nullopt;  ///< a depth to overlook; by default 1e-3 of the smaller one's size
};

enum class SpawnFault : std::uint8_t {
    inside,     ///< the character, or the point, is in an object
    beneath,    ///< the first thing above it is seen from behind: it is below a ground, outside of the level
    no_ground,  ///< there is nothing at all below it
};

template <int D>
struct SpawnFinding {
    std::size_t place = 0;  ///< of LevelView::places
    SpawnFault fault = SpawnFault::inside;
    std::optional<std::size_t> object = std::nullopt;  ///< which one it is in, the deepest one, or under
    float depth = 0;                                   ///< inside: how deep
    std::optional<Vec<D>> free = std::nullopt;         ///< the place near by where the spawn would be free, if found
};

/// The places that a pattern describes, by path, name or class.
template <int D>
std::vector<std::size_t> described_places(const LevelView<D>& level, const std::string& pattern);

/// Places whose name or class holds "spawn", "player_start", "playerstart" or "player start", in capitals or not; none
/// that has another such place below it, which makes it a group.
template <int D>
std::vector<std::size_t> usual_spawns(const LevelView<D>& level);

/// What is wrong with the spawns. Objects at or below their nodes mark them, and are in nobody's way. A character
/// stands on slopes of up to 60 degrees: as deep as its round end reaches into one that goes through its lowest point
/// isn't deep. Whether a spawn is below a ground or has none is looked at where there is an up.
template <int D>
std::vector<SpawnFinding<D>> find_spawn_faults(const LevelView<D>& level, const std::vector<std::size_t>& spawns,
                                               const SpawnOptions<D>& options);

}  // namespace abut::tool
