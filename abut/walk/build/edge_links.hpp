#pragma once

// The adjacency of a walk mesh's triangles. Not for users.

#include <abut/math/vec.hpp>
#include <abut/walk/data.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

struct WalkLinks {
    std::vector<std::array<WalkLink, 3>> of;  ///< by triangle and side
    std::size_t non_manifold_edges = 0;       ///< edges of more than two triangles
    std::size_t mirrored = 0;                 ///< edges that both triangles traverse in the same direction
    std::size_t border = 0;                   ///< sides without a neighbour
};

/// Links triangles with welded points across their edges. At a non-manifold edge of up to 64 triangles, the pair with
/// the flattest dihedral angle is linked first, then the flattest of the rest; one may remain. At an edge of more than
/// 64 none are linked.
WalkLinks link_triangles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace abut::detail
