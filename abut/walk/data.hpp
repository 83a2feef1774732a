#pragma once

// The stored data of a walk mesh. Not for users.

#include <abut/math/detail/large_pages.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/mesh/tree.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace abut::detail {

/// The neighbour across a side: its triangle, its side, and whether both triangles traverse the shared edge in the same
/// direction. They then disagree which side is up.
struct WalkLink {
    std::uint32_t code = none;

    static constexpr std::uint32_t none = 0xffffffffu;
    static WalkLink to(std::uint32_t triangle, std::uint32_t side, bool mirrored) {
        return {triangle << 3 | (mirrored ? 4u : 0u) | side};
    }
    bool is_border() const { return code == none; }
    std::uint32_t triangle() const { return code >> 3; }
    std::uint32_t side() const { return code & 3u; }
    bool mirrored() const { return (code & 4u) != 0; }
};

/// One triangle in two cache lines. Tracing a geodesic over many triangles reads only the first.
struct alignas(128) WalkTriangle {
    /// For side k: the opposite corner of the neighbour, unfolded into this triangle's plane, in units of the side's
    /// length. `back` is measured from the side's midpoint along it, towards corner k; `away` at right angles to it. 0
    /// at a border.
    double back[3]{}, away[3]{};
    WalkLink link[3];
    std::uint32_t area = 0;

    /// The corners in space. In the triangle's frame they are (0, 0), (width, 0), (third, height).
    Vec3 corner[3]{};
    float padding = 0;
    double inverse_width = 0;  ///< 1 / |corner 1 - corner 0|; 0 if the triangle is left out
    double third = 0;
    double inverse_height = 0;

    bool is_walkable() const { return inverse_width != 0; }
};
static_assert(sizeof(WalkTriangle) == 128);

struct WalkMeshData {
    WalkMeshReport report;
    std::vector<Vec3> points;  ///< as in the input
    std::vector<glm::uvec3> triangles;
    std::vector<WalkTriangle, LargePages<WalkTriangle>> walk;  ///< one per triangle
    std::vector<std::uint32_t> components;                     ///< one per triangle; 0 if left out
    std::vector<Vec3> normals;               ///< unit length or 0: of the points if given, otherwise of vertex fans
    std::vector<glm::uvec3> corner_normals;  ///< one per triangle: indices into `normals`
    bool given_normals = false, given_areas = false;
    /// Holds the walkable triangles; its items are triangle numbers of the mesh.
    MeshTree tree;
    std::vector<std::uint32_t> leaf_of;  ///< one per triangle: the tree's leaf that contains it; 0 if left out
    Aabb3 bounds = Aabb3::empty();
};

inline std::uint32_t next_corner(std::uint32_t corner) {
    return corner == 2 ? 0 : corner + 1;
}

}  // namespace abut::detail
