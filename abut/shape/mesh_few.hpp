#pragma once

// Few triangles, of which leaves of a mesh's tree are made: each place on each axis is tried for a split. For .cpp
// files.

#include <abut/broad_phase/bvh_node.hpp>
#include <abut/shape/mesh_tree.hpp>

#include <array>
#include <cstdint>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// At most so many; their corners are told by the bits of one word.
inline constexpr std::uint32_t mesh_few = 16;

/// They don't change; a part of them is told by its order along each axis.
class FewTriangles {
public:
    /// `same` names each point by the lowest one at its position.
    FewTriangles(std::span<const BvhItem> items, std::span<const glm::uvec3> triangles,
                 std::span<const std::uint32_t> same);

    struct Part {
        std::array<std::array<std::uint8_t, mesh_few>, 3> order;
        std::uint32_t count = 0;
    };

    Part all() const;
    /// Whether they have room in one leaf.
    bool fit(const Part& part) const;
    Aabb3 box(const Part& part) const;
    /// They are one: the numbers of its triangles in the mesh go to `order`, from where the leaf's are.
    void fill(const Part& part, std::span<const Vec3> points, MeshLeaf& leaf, std::uint32_t* order) const;
    /// Where the areas of the two sides, each times its leaves, are least. Of at least two.
    void split(const Part& part, Part& left, Part& right) const;

private:
    using Corners = std::uint64_t;

    std::uint8_t number_of(std::uint32_t point, std::array<std::uint8_t, 256>& table);

    std::uint32_t count_, known_count_ = 0;
    std::array<BvhItem, mesh_few> items_;
    std::array<std::array<std::uint8_t, 3>, mesh_few> corner_;  ///< of each triangle, by their place in `known_`
    std::array<Corners, mesh_few> corners_;                     ///< the same, a bit each
    std::array<std::uint32_t, 3 * mesh_few> known_;             ///< points
};

}  // namespace abut
