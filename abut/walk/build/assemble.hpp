#pragma once

// Assembles a walk mesh from cleaned-up, linked triangles. Not for users.

#include <abut/shape/weld.hpp>
#include <abut/walk/build/edge_links.hpp>
#include <abut/walk/data.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// The walkable triangles, with welded points and nonzero areas, and their ascending numbers in the mesh.
struct Walkable {
    Welded surface;
    std::vector<std::uint32_t> number;
};

/// Computes everything that follows from the triangles, their links and their tree: frames, unfolded corners, connected
/// components, normals if none are given, and the report's counts of links. `data` already holds the points, triangles,
/// given normals (of length 1 or 0), areas, and one `walk` per triangle.
void assemble(WalkMeshData& data, const Walkable& walkable, const WalkLinks& links, MeshTree tree);

struct LinkedTriangles {
    Walkable walkable;
    WalkLinks links;
};

/// The inverse of `assemble`.
LinkedTriangles disassemble(const WalkMeshData& data);

}  // namespace abut::detail
