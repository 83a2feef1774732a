#pragma once

// The moves at which one feature of a solid touches one of another: where the least move that parts them lies in front
// of a single plane, it is one of these. For .cpp files.

#include <abut/query/detail/solid/placed_solid.hpp>

namespace abut::detail {

/// What the moves are for.
struct TouchingMoveVisitor {
    /// Only shorter moves are wanted; it may shrink with each visit.
    FunctionRef<double()> limit;
    /// Only longer moves are wanted along the directions on the shorter arc between two.
    FunctionRef<double(const DVec<3>& first, const DVec<3>& last)> least;
    /// A move of B.
    FunctionRef<void(const DVec<3>& direction, double distance)> visit;
};

/// Visits the moves along the normals of faces at which a corner of one solid, that was behind a face of the other,
/// comes to lie on it, and those along the common normal of two convex edges at which they touch. There neither feature
/// is beyond the other's neighbours, up to a tolerance. Other features may be: most moves leave the solids overlapping.
void each_touching_move(const PlacedSolid& a, const PlacedSolid& b, const TouchingMoveVisitor& visitor);

}  // namespace abut::detail
