#pragma once

// The inside of shapes. Questions about a mesh are about its surface, those about a chain about its lines; of two
// bodies that touch nowhere, or meet face on face all over, it takes a point of the inside to say whether they are in
// one another.

#include <abut/abut.hpp>
#include <abut/io/level.hpp>

namespace abut::tool {

/// A point of a shape, in the shape's own frame, and how deep it is under the surface: the farther the better.
template <int D>
struct InsidePoint {
    Vec<D> point{};
    float depth = 0;  ///< 0: on the surface
};

InsidePoint<3> inside_point(const Polyhedron& solid);

/// `filled` says that the mesh is the surface of a body, wound outwards: then the point is one of the body.
InsidePoint<3> inside_point(const Mesh& mesh, bool filled);

/// `filled` says that lines of the shape go around a body, as in LevelObject.
InsidePoint<2> inside_point(const LevelShape& shape, bool filled);

}  // namespace abut::tool
