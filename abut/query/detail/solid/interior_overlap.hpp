#pragma once

// Whether the interiors of two solids share a point, decided exactly. For .cpp files.
//
// If they do, then one of these holds:
//
//   - two triangles cross in a segment that is inside both of them;
//   - an edge of one solid lies in a triangle or along an edge of the other, and a sector around it is inside both;
//   - a connected component of one surface is inside the other solid, and touches it in points at most.
//
// For an edge is inside the other solid somewhere, if the second doesn't hold. From there the component is inside as
// far as one walks over its triangles. Around a point where it is not so any more, some triangle has a direction
// inside, one outside or on the surface, and between them the surface of the other solid: then the triangle crosses it,
// or has an edge of it inside. So everything is decided by the signs of determinants at triangles that touch, and by
// the winding number of one point of each component.

#include <abut/query/detail/solid/placed_solid.hpp>

namespace abut::detail {

/// Touching solids share no inner point, however large the area is in which they touch. A direction in which B lies
/// mostly beyond A makes it faster.
bool interiors_overlap(const PlacedSolid& a, const PlacedSolid& b, const DVec<3>& direction = DVec<3>(0.0));

/// Whether a connected component of the surface of one solid is inside the other.
bool has_component_inside(const PlacedSolid& inner, const PlacedSolid& outer);

/// Visits the pairs of triangles whose boxes are at most `reach` apart, with their corners; with a direction, at least
/// those of them that are as near along it. Returns false if a visit did, which stops it.
using TrianglePairVisitor =
    FunctionRef<bool(std::uint32_t triangle_a, const Corners& a, std::uint32_t triangle_b, const Corners& b)>;
bool each_triangle_pair(const PlacedSolid& a, const PlacedSolid& b, float reach, TrianglePairVisitor visit,
                        const DVec<3>& direction = DVec<3>(0.0));

}  // namespace abut::detail
