#pragma once

// A walk mesh of triangles that are tidy and linked. Not for users.

#include <abut/shape/weld.hpp>
#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_links.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The triangles that there are to walk on, by points that are welded, each with an area; and which of the mesh each
/// one is, in increasing order.
struct Walkable {
    Welded surface;
    std::vector<std::uint32_t> number;
};

/// All that follows from the triangles, their links and the tree of these triangles: frames, unfolded corners, islands,
/// normals where none are given, and of the report what tells of links. `data` has the rest: points, triangles, given
/// normals, of length 1 or 0, areas, as many `walk` as triangles.
void assemble(WalkMeshData& data, const Walkable& walkable, const WalkLinks& links, MeshTree tree);

struct LinkedTriangles {
    Walkable walkable;
    WalkLinks links;
};

/// What a mesh was assembled from.
LinkedTriangles taken_apart(const WalkMeshData& data);

}  // namespace abut
