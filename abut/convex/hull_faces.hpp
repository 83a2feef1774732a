#pragma once

// From the triangles of a hull to its faces.

#include <abut/convex/quickhull.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The faces of a polytope as loops of point numbers, counter-clockwise seen from outside.
struct HullFaces {
    std::vector<Vec3> normals;             ///< one a face, of length 1, outwards
    std::vector<std::uint32_t> loops;      ///< the point numbers of all faces, one after the other
    std::vector<std::uint32_t> loop_ends;  ///< one a face: where its loop ends in `loops`

    /// The point numbers of one face.
    std::span<const std::uint32_t> loop(std::size_t face) const {
        const std::size_t begin = face == 0 ? 0 : loop_ends[face - 1];
        return std::span(loops).subspan(begin, loop_ends[face] - begin);
    }
};

/// Joins the triangles of a convex surface to faces. Coplanar ones become one face, and points that are then inside of
/// faces or edges no longer occur: this is exact. After that, neighbours become one face wherever its corners lie in a
/// slab no thicker than `flatness` and its loop stays convex, to within `tolerance` (both in steps of the grid).
/// Every edge belongs to two loops, one each way, and the surface keeps the topology of the sphere.
HullFaces hull_faces(std::span<const GridPoint> points, const TriangleSurface& surface, double tolerance,
                     double flatness);

}  // namespace abut
