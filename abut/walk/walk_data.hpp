#pragma once

// What a walk mesh is made of. Not for users.

#include <abut/math/dvec.hpp>
#include <abut/math/large_pages.hpp>
#include <abut/shape/mesh_tree.hpp>
#include <abut/walk/walk_mesh.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace abut {

/// What is beyond a side: the triangle, the side of it that is shared, and whether the two go along that side the same
/// way, so that what is up in one is down in the other.
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

/// Two cache lines. Of the first alone, a walk over many triangles unfolds one after another.
struct alignas(128) WalkTriangle {
    /// Of side k: where the corner is that the triangle beyond it has opposite of it, the two unfolded into one plane
    /// and the side being of length 1: from the middle of the side, how far back along it (towards corner k), and how
    /// far beyond. 0 at a border.
    double back[3]{}, away[3]{};
    WalkLink link[3];
    std::uint32_t area = 0;

    /// Its corners, and where they are in its frame: (0, 0), (width, 0), (third, height).
    Vec3 corner[3]{};
    float padding = 0;
    double inverse_width = 0;  ///< 1 / |corner 1 - corner 0|; 0 where the triangle is left out
    double third = 0;
    double inverse_height = 0;

    bool is_walkable() const { return inverse_width != 0; }
};
static_assert(sizeof(WalkTriangle) == 128);

struct WalkMeshData {
    WalkMeshReport report;
    std::vector<Vec3> points;  ///< as given
    std::vector<glm::uvec3> triangles;
    std::vector<WalkTriangle, LargePages<WalkTriangle>> walk;  ///< as many
    std::vector<std::uint32_t> islands;                        ///< as many; 0 where left out
    std::vector<Vec3> normals;  ///< of length 1, or 0: of the points where given, else of fans of triangles
    std::vector<glm::uvec3> corner_normals;  ///< one a triangle, into `normals`
    bool given_normals = false, given_areas = false;
    /// Of the triangles that are walkable; item i of its order is a number of a triangle here.
    MeshTree tree;
    std::vector<std::uint32_t> leaf_of;  ///< as many as triangles: the tree's leaf that has it; 0 where left out
    Aabb3 bounds = Aabb3::empty();
};

inline std::uint32_t next_corner(std::uint32_t corner) {
    return corner == 2 ? 0 : corner + 1;
}

}  // namespace abut
