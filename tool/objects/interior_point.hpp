#pragma once

// Interior points of shapes. Queries of a mesh refer to its surface and those of a chain to its lines. If two bodies
// don't touch, or touch face to face, an interior point decides whether one is inside the other.

#include <abut/abut.hpp>
#include <abut/io/level.hpp>

namespace abut::tool {

/// A point of a shape in the shape's frame, and its depth below the surface.
template <int D>
struct InteriorPoint {
    Vec<D> point{};
    float depth = 0;  ///< 0: on the surface
};

InteriorPoint<3> interior_point(const Polyhedron& solid);

/// `filled`: the mesh bounds a body and is oriented outwards; the point is in the interior then.
InteriorPoint<3> interior_point(const Mesh& mesh, bool filled);

/// `filled`: lines of the shape bound a body, as in LevelObject.
InteriorPoint<2> interior_point(const LevelShape& shape, bool filled);

}  // namespace abut::tool
