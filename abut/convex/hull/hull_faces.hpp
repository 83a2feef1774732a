#pragma once

// Merges the triangles of a hull into faces.

#include <abut/convex/hull/quickhull.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// The faces of a polytope as loops of point numbers, counter-clockwise seen from outside.
struct HullFaces {
    std::vector<Vec3> normals;             ///< one per face, of length 1, outwards
    std::vector<std::uint32_t> loops;      ///< the point numbers of all faces, one after the other
    std::vector<std::uint32_t> loop_ends;  ///< one per face: the end of its loop in `loops`

    /// The point numbers of one face.
    std::span<const std::uint32_t> loop(std::size_t face) const {
        const std::size_t begin = face == 0 ? 0 : loop_ends[face - 1];
        return std::span(loops).subspan(begin, loop_ends[face] - begin);
    }
};

/// Merges the triangles of a convex surface into faces. Coplanar triangles become one face, and points inside of faces
/// or edges are dropped: this is exact. Then neighbours are merged if their corners lie in a slab no thicker than
/// `flatness` and their loop stays convex to within `tolerance` (both in steps of the grid). Every edge belongs to two
/// loops, one in each direction, and the surface stays a topological sphere.
HullFaces hull_faces(std::span<const GridPoint> points, const TriangleSurface& surface, double tolerance,
                     double flatness);

}  // namespace abut::detail
