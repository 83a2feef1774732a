#pragma once

// Moves to where planes meet, for the search of the least move that parts two solids. For .cpp files.

#include <abut/math/dvec.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace abut::detail {

/// Moves of B with dot(normal, move) >= distance.
struct MovePlane {
    DVec<3> normal{0.0};  ///< of length 1
    double distance = 0;
};

/// The nearest planes, each once.
class NearestPlanes {
public:
    void add(const MovePlane& plane, double limit);
    std::span<const MovePlane> all() const { return {planes_.data(), count_}; }

private:
    std::array<MovePlane, 32> planes_;
    std::size_t count_ = 0;
};

/// The least move in front of up to four planes.
struct MeetOfPlanes {
    std::array<MovePlane, 4> planes;
    std::size_t count = 0;
    DVec<3> move{0.0};
    double distance = 0;  ///< length of the move
};

/// Adds a plane. There is none if a fifth plane is needed, or if no move is in front of all.
std::optional<MeetOfPlanes> with_plane(const MeetOfPlanes& meet, const MovePlane& plane);

/// The least move that is farther in front of all planes.
MeetOfPlanes farther_by(const MeetOfPlanes& meet, double distance);

/// The nearest moves, up to a capacity, beyond which the farthest are dropped.
class MoveQueue {
public:
    /// A move that is as far as the limit, or that was added before, is left out.
    void add(const MeetOfPlanes& meet, double limit);
    std::optional<MeetOfPlanes> take_nearest();

private:
    std::array<MeetOfPlanes, 128> sorted_;  ///< farthest first
    std::size_t count_ = 0;
    std::array<DVec<3>, 512> known_;
    std::size_t known_count_ = 0;
};

}  // namespace abut::detail
