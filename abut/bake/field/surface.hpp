#pragma once

// A mesh prepared for baking: welded, oriented consistently, its holes capped. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

struct FieldSurface {
    Welded mesh;                               ///< all triangles with three distinct corners, oriented consistently
    std::vector<std::uint32_t> nondegenerate;  ///< the numbers of the triangles with an area
    Aabb3 box = Aabb3::empty();                ///< bounds of the triangles with an area
    std::size_t rewound = 0;                   ///< triangles whose orientation was flipped
    std::size_t gaps = 0;                      ///< edges that are not traversed equally often in both directions

    /// Triangles over the holes. With them every edge is traversed equally often in both directions. Empty if the
    /// surface is closed.
    std::vector<glm::uvec3> cap;
};

/// Returns the Problems of `bake_field`.
Result<FieldSurface> field_surface(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace abut::detail
