#pragma once

// Exhaustive surface area splits of small triangle sets into leaves of a mesh's tree. For .cpp files.

#include <abut/broad_phase/bvh/node.hpp>
#include <abut/shape/mesh/tree.hpp>

#include <array>
#include <cstdint>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// The maximum size of a small set; the bits of one word hold its vertices.
inline constexpr std::uint32_t max_small_set = 16;

/// An immutable small set of triangles. A part of it is given by its order along each axis.
class SmallTriangleSet {
public:
    /// `same` maps each point to the lowest index at its position.
    SmallTriangleSet(std::span<const BvhItem> items, std::span<const glm::uvec3> triangles,
                     std::span<const std::uint32_t> same);

    struct Part {
        std::array<std::array<std::uint8_t, max_small_set>, 3> order;
        std::uint32_t count = 0;
    };

    Part all() const;
    /// True if the part fits in one leaf.
    bool fits_leaf(const Part& part) const;
    Aabb3 box(const Part& part) const;
    /// Writes a part that fits one leaf. The triangles' indices in the mesh go to `order`.
    void fill(const Part& part, std::span<const Vec3> points, MeshLeaf& leaf, std::uint32_t* order) const;
    /// Splits a part of two or more triangles where the sum of side areas times estimated leaf counts is smallest.
    void split(const Part& part, Part& left, Part& right) const;

private:
    using VertexBits = std::uint64_t;

    std::uint8_t vertex_number(std::uint32_t point, std::array<std::uint8_t, 256>& table);

    std::uint32_t count_, vertex_count_ = 0;
    std::array<BvhItem, max_small_set> items_;
    std::array<std::array<std::uint8_t, 3>, max_small_set>
        triangle_vertices_;                                  ///< corners of each triangle, as indices into `vertices_`
    std::array<VertexBits, max_small_set> vertex_bits_;      ///< corners of each triangle as a bit set
    std::array<std::uint32_t, 3 * max_small_set> vertices_;  ///< point indices
};

}  // namespace abut::detail
