#pragma once

// Overlap, distance and contact of a solid and another shape. For .cpp files.
//
// Two solid meshes, or one and a box or a polyhedron, are compared exactly. Any other convex shape is compared with the
// triangles of the solid, and with its inside by one point. A composite shape is the union of its parts.

#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>

namespace abut::detail {

/// Whether one shape is the solid of a mesh, and the other one neither a half-space nor a distance function, which
/// reach what is inside by the triangles alone; never in the plane.
inline bool has_solid(const View<2>&, const View<2>&) {
    return false;
}
bool has_solid(const View<3>& a, const View<3>& b);
/// Whether both shapes are solids that are compared exactly.
inline bool are_solids(const View<2>&, const View<2>&) {
    return false;
}
bool are_solids(const View<3>& a, const View<3>& b);

// For pairs with a solid.

/// The tolerance of distances.
double solid_tolerance(const View<3>& a, const View<3>& b);

/// Whether one of two shapes whose surfaces don't touch, or a part of it, is inside the other.
bool is_inside_other(const View<3>& a, const View<3>& b);
/// If a shape shares a point with the interior of the other, a move that parts the two; of a composite shape, the
/// deepest part. Otherwise false. Names the closest points only if `names_points`.
bool find_depth(const View<3>& a, const View<3>& b, bool names_points, Closest<3>& closest);
/// If the surfaces of two solids without a common inner point touch: the distance 0, and a direction in which B leaves
/// A.
void name_touching(const View<3>& a, const View<3>& b, bool names_points, Closest<3>& closest);

/// The closest points, or else their distance and normal alone.
Closest<3> closest_to_solid(const View<3>& a, const View<3>& b, const QueryOptions<3>& options, bool names_points);

/// Returns false, and writes nothing, if the contacts are those of the parts of the two shapes.
bool find_solid_contact(const View<3>& a, const View<3>& b, float margin, Contact<3>& result);
/// Visits a contact for each plane on which the shapes touch after the move that parts them. `touch` is whether there
/// is one. Returns false, and visits none, if the contacts are those of the parts of the two shapes.
bool each_solid_contact(const View<3>& a, const View<3>& b, float margin,
                        FunctionRef<bool(const Contact<3>& contact)> visit, bool& touch);

}  // namespace abut::detail
