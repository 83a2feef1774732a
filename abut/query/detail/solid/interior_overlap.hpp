#pragma once

// Whether the interiors of two solids share a point, decided exactly. For .cpp files.
//
// If they do, then one of these holds:
//
//   - two triangles cross in a segment that is inside both of them;
//   - at some point of an edge, away from all corners, a sector around the edge is inside both solids. The edge lies in
//     a triangle or along an edge of the other solid there, or it is inside the other solid;
//   - a connected component of a surface is inside the other solid and touches it nowhere.
//
// An edge that is inside somewhere, and touches the other surface elsewhere, is inside next to a point where it
// touches. So everything is decided at pairs of triangles that touch, by the signs of determinants, without any point
// that would have to be computed.

#include <abut/query/detail/solid/placed_solid.hpp>

namespace abut::detail {

/// Touching solids share no inner point, however large the area is in which they touch.
bool interiors_overlap(const PlacedSolid& a, const PlacedSolid& b);

/// Whether a connected component of the surface of one solid is inside the other.
bool has_component_inside(const PlacedSolid& inner, const PlacedSolid& outer);

/// Visits the pairs of triangles whose boxes are at most `reach` apart, with their corners. Returns false if a visit
/// did, which stops it.
using TrianglePairVisitor =
    FunctionRef<bool(std::uint32_t triangle_a, const Corners& a, std::uint32_t triangle_b, const Corners& b)>;
bool each_triangle_pair(const PlacedSolid& a, const PlacedSolid& b, float reach, TrianglePairVisitor visit);

}  // namespace abut::detail
