#pragma once

// Exact answers for two solids that are unions of convex parts: whether their interiors share a point, in rational
// numbers, and the least move that parts them, by their Minkowski sums.

#include "../../scenes/kit.hpp"

#include <optional>
#include <vector>

namespace abut::oracle {

/// Whether the interiors share a point, after the pieces have been moved to two places.
bool interiors_overlap(const scenes::KitPiece& a, const Vec3& at_a, const scenes::KitPiece& b, const Vec3& at_b);

/// Moves with dot(normal, move) < distance.
struct MoveHalfSpace {
    DVec<3> normal{0.0};  ///< of length 1
    double distance = 0;
};

/// The moves of B at which the interiors of two pieces share a point: the Minkowski sums of the parts of one and the
/// mirrored parts of the other, by half-spaces whose offsets are found in rational numbers.
class OverlappingMoves {
public:
    OverlappingMoves(const scenes::KitPiece& a, const Vec3& at_a, const scenes::KitPiece& b, const Vec3& at_b);

    /// The length of the least translation that parts the interiors, by a search over half-spaces, nearest first. None
    /// if it takes too long.
    std::optional<double> least_separation() const;
    /// How far B moves along a direction until it is parted from A for the first time.
    double separation_along(const DVec<3>& direction) const;

private:
    std::vector<std::vector<MoveHalfSpace>> sums_;
};

}  // namespace abut::oracle
