#pragma once

// Exact answers for two solids that are unions of convex parts: whether their interiors share a point, in rational
// numbers, and the least move that parts them, by their Minkowski sums.

#include "../../scenes/kit.hpp"

#include <optional>

namespace abut::oracle {

/// Whether the interiors share a point, after the pieces have been moved to two places.
bool interiors_overlap(const scenes::KitPiece& a, const Vec3& at_a, const scenes::KitPiece& b, const Vec3& at_b);

/// The length of the least translation of B that parts the interiors; the search is nearest first over the half-spaces
/// outside of the Minkowski sums of parts, whose offsets are rational. None if it takes too long.
std::optional<double> least_separation(const scenes::KitPiece& a, const Vec3& at_a, const scenes::KitPiece& b,
                                       const Vec3& at_b);

/// How far B moves along a direction until it is parted from A for the first time.
double separation_along(const scenes::KitPiece& a, const Vec3& at_a, const scenes::KitPiece& b, const Vec3& at_b,
                        const DVec<3>& direction);

}  // namespace abut::oracle
