#pragma once

// Minkowski sums of polytopes, by their corners: every corner of A + B is a corner of A plus a corner of B. The two are
// the farthest of A and of B along the same direction, so nothing has to be built in order to find which they are.

#include <abut/convex/facets.hpp>

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace abut {

/// A corner of a sum: the numbers of the two that it is the sum of.
struct CornerPair {
    std::uint32_t a = 0, b = 0;

    friend bool operator==(const CornerPair&, const CornerPair&) = default;
    friend bool operator<(const CornerPair& p, const CornerPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); }
};

/// The corners of A + B, counter-clockwise from the lexicographically least, for convex loops of one corner or more,
/// counter-clockwise, none of them twice. The edges of both are merged by their directions, which are compared exactly;
/// parallel ones become one. At most n + m pairs in O(n + m) steps.
std::vector<CornerPair> sum_corners(std::span<const DVec<2>> a, std::span<const DVec<2>> b);

/// A polytope in space by its surface.
struct Surface {
    std::span<const DVec<3>> corners;
    const Facets* facets = nullptr;  ///< loops and edges over the corners; null where those lie on a line
    bool mirrored = false;           ///< the loops are clockwise seen from outside
};

/// All corners of A + B, in order and each once, and perhaps some of its points that are none.
///
/// By the Gauss map (Fogel, Halperin: "Exact and efficient construction of Minkowski sums of convex polyhedra", 2007):
/// on the sphere of directions a face is a point, an edge the arc between two faces, a corner the cell in which it is
/// the farthest. The cells of A and B, laid over one another, are the cells of A + B. Each has a point on its boundary
/// that is a face of A, a face of B, or where an arc of A crosses one of B (Gregorius: "The Separating Axis Test
/// between Convex Polyhedra", 2013); so the pairs that are farthest there, or within 2^-23 of the size of it, are all
/// there are. O(n m) steps for n and m corners, of a few comparisons each; k log k for the k pairs found.
std::vector<CornerPair> sum_corners(const Surface& a, const Surface& b);

}  // namespace abut
