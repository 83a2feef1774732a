#pragma once

// The search of the least move that parts a solid from another shape: along directions, and to where planes meet. For
// .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/dvec.hpp>

#include <array>
#include <cstddef>
#include <limits>
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

/// A translation of B.
struct SeparatingMove {
    Vec3 normal{1, 0, 0};  ///< of length 1 up to rounding
    float depth = 0;
};

/// The least move of B so far that parts it from A. Every move that is taken has been tested as the floats that it is
/// reported in.
class LeastMoveSearch {
protected:
    static constexpr double unlimited_move = std::numeric_limits<double>::infinity();

    /// Where a move along a direction parts the two for the first time; infinite if that is beyond the limit.
    struct Exit {
        double distance = unlimited_move;
        DVec<3> normal{0.0};  ///< of the last plane
    };

    LeastMoveSearch() = default;
    LeastMoveSearch(const LeastMoveSearch&) = delete;
    ~LeastMoveSearch() = default;

    virtual bool parts(const DVec<3>& move) const = 0;
    virtual Exit exit_along(const DVec<3>& direction, double limit) = 0;
    /// Whether a quick test leaves open that a direction leads to a shorter move.
    virtual bool may_improve(const DVec<3>& direction) = 0;
    /// Adds the planes to which B must move at least, so that triangles part that cross after a move.
    virtual void collect_planes(const DVec<3>& move, NearestPlanes& planes) const = 0;

    /// Longer moves don't matter.
    double limit() const { return best_distance_ * (1 - 1e-9) - tolerance_; }
    /// Takes a move that parts the two in double, if it does so as floats too, or slightly longer.
    bool take(const DVec<3>& direction, double distance);
    void try_direction(DVec<3> direction);
    /// The move out of the box along the best axis.
    void leave_box(const Aabb<3>& a, const Aabb<3>& b);
    /// Tries up to `max_meets` moves to where planes meet, nearest first, and again `farther` in front of the planes.
    void search_meets(int max_meets, double farther);

    SeparatingMove best_;
    double best_distance_ = unlimited_move;
    double tolerance_ = 0;   ///< a distance that parts may be off by
    double float_step_ = 0;  ///< a distance that floats may be off by

private:
    bool take_meet(const MeetOfPlanes& meet);
};

}  // namespace abut::detail
