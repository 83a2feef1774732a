#pragma once

// The triangle of a walk mesh that is nearest to a point. For .cpp files.

#include <abut/shape/mesh_tree.hpp>

#include <cstdint>
#include <limits>

namespace abut {

/// The nearest so far.
struct NearestTriangle {
    /// Of twice the distance, as `nearest_on` has it; until one is found, of twice the reach.
    double square = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = none;
    std::uint32_t leaf = 0, lane = 0;  ///< where the tree has it

    static constexpr std::uint32_t none = 0xffffffffu;
    bool is_found() const { return triangle != none; }
};

/// What measuring all triangles one by one would find, to the last bit: of those for which the same square comes out
/// the one with the lowest number. The point is finite. Begins with the triangles of a leaf, none: with the root.
void find_nearest(const MeshTree& tree, const Vec3& point, std::uint32_t first_leaf, NearestTriangle& nearest);

}  // namespace abut
