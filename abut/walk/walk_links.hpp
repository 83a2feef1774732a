#pragma once

// Which triangles of a walk mesh go on in which. Not for users.

#include <abut/math/vec.hpp>
#include <abut/walk/walk_data.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

struct WalkLinks {
    std::vector<std::array<WalkLink, 3>> of;  ///< by triangle and side
    std::size_t crowded = 0;                  ///< edges of more than two triangles
    std::size_t mirrored = 0;                 ///< edges whose two triangles go along them the same way
    std::size_t border = 0;                   ///< sides with nothing beyond
};

/// Of points that are welded. Two triangles at an edge are linked. Of more, up to 64, those two first that bend least
/// at it, then those of the others that do; one may be left over. Of more than 64, none.
WalkLinks link_triangles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace abut
