#pragma once

// Overlap, distance and contact of two solids. For .cpp files.

#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>

namespace abut::detail {

/// Whether one shape is the solid of a mesh, and the other one too, or a box, a polyhedron or a ball; never in the
/// plane.
inline bool are_solids(const View<2>&, const View<2>&) {
    return false;
}
bool are_solids(const View<3>& a, const View<3>& b);

// For two solids.

/// Whether one of two solids whose surfaces don't touch is inside the other.
bool is_inside_other(const View<3>& a, const View<3>& b);
/// If the interiors share a point, the least move that parts the solids. Otherwise false.
bool find_depth(const View<3>& a, const View<3>& b, Closest<3>& closest);
/// If the surfaces of two solids without a common inner point touch: the distance 0, and a direction in which B leaves
/// A.
void name_touching(const View<3>& a, const View<3>& b, Closest<3>& closest);
/// The contact at a distance that is known.
Contact<3> contact_of_solids(const View<3>& a, const View<3>& b, const Closest<3>& closest);

}  // namespace abut::detail
