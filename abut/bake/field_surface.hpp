#pragma once

// The surface of a mesh as a field is baked of it: welded, wound alike, and closed by triangles over its holes. For
// .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

struct FieldSurface {
    Welded mesh;                       ///< all triangles with three corners, wound alike
    std::vector<std::uint32_t> solid;  ///< those of them with an area
    Aabb3 box = Aabb3::empty();        ///< around these
    std::size_t rewound = 0;           ///< triangles that were turned
    std::size_t gaps = 0;              ///< edges that are run along more often one way than the other

    /// Over the holes, so that with them every edge is run along as often one way as the other. None where that is so
    /// already.
    std::vector<glm::uvec3> cap;
};

/// A Problem as `bake_field` has it.
Result<FieldSurface> field_surface(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace abut
