#pragma once

// Minkowski sums of polytopes by their corners. Every corner of A + B is a corner of A plus a corner of B, the support
// points along one direction, so nothing has to be built to find the pairs.

#include <abut/convex/facets.hpp>

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace abut::detail {

/// A corner of a sum: the numbers of its two terms.
struct CornerPair {
    std::uint32_t a = 0, b = 0;

    friend bool operator==(const CornerPair&, const CornerPair&) = default;
    friend bool operator<(const CornerPair& p, const CornerPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }
};

/// The corners of A + B, counter-clockwise from the lexicographically least, for convex loops of one or more distinct
/// corners, counter-clockwise. The edges of both are merged by direction, with exact comparisons; parallel ones become
/// one. At most n + m pairs in O(n + m) steps.
std::vector<CornerPair> sum_corners(std::span<const DVec<2>> a, std::span<const DVec<2>> b);

/// The surface of a polytope in 3D.
struct SummandSurface {
    std::span<const DVec<3>> corners;
    const Facets* facets = nullptr;  ///< loops and edges over the corners; null if the corners are collinear
    bool mirrored = false;           ///< the loops are clockwise seen from outside
};

/// All corners of A + B, sorted and unique, and possibly some other points of it.
///
/// By the Gauss map (Fogel, Halperin: "Exact and efficient construction of Minkowski sums of convex polyhedra", 2007):
/// on the sphere of directions a face is a point, an edge the arc between two faces, and a corner the cell in which it
/// is the support point. The overlay of the cells of A and B gives the cells of A + B. Each has a point on its boundary
/// that is a face of A, a face of B, or a crossing of an arc of A and an arc of B (Gregorius: "The Separating Axis Test
/// between Convex Polyhedra", 2013). So the pairs of support points there, to within 2^-23 of the size, are all pairs.
/// O(n m) steps for n and m corners, of a few comparisons each; k log k for the k pairs found.
std::vector<CornerPair> sum_corners(const SummandSurface& a, const SummandSurface& b);

}  // namespace abut::detail
