#pragma once

// A convex set with flat faces, as its corners and the loops of its faces. For the drawing functions.

#include <abut/convex/support.hpp>

#include <vector>

namespace abut {

/// In the world, without the ball around the set.
struct PlacedFaces {
    struct FaceLoop {
        DVec<3> normal;                      ///< of length 1, outwards; zero where the placement has flattened the face
        std::vector<std::uint32_t> corners;  ///< counter-clockwise seen from outside
    };
    std::vector<DVec<3>> corners;
    std::vector<FaceLoop> faces;
};

/// Box, triangle (two faces, back to back) or polyhedron; without faces for anything else.
PlacedFaces placed_faces(const Convex<3>& convex);

}  // namespace abut
