#pragma once

// The corners and face loops of a convex set with flat faces. For the drawing functions.

#include <abut/convex/support.hpp>

#include <vector>

namespace abut::detail {

/// In world coordinates, without the set's radius.
struct PlacedFaces {
    struct FaceLoop {
        DVec<3> normal;                      ///< unit length, outwards; zero if the placement has flattened the face
        std::vector<std::uint32_t> corners;  ///< counter-clockwise seen from outside
    };
    std::vector<DVec<3>> corners;
    std::vector<FaceLoop> faces;
};

/// The faces of a box, a triangle (two faces, back to back) or a polyhedron; other sets have none.
PlacedFaces placed_faces(const Convex<3>& convex);

}  // namespace abut::detail
