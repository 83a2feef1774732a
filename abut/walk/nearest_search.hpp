#pragma once

// The nearest triangle of a walk mesh. For .cpp files.

#include <abut/shape/mesh/tree.hpp>

#include <cstdint>
#include <limits>

namespace abut::detail {

/// The nearest triangle so far.
struct NearestTriangle {
    /// Squared double distance, as `nearest_on` computes it. It is that of the reach until a triangle is found.
    double square = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = none;
    std::uint32_t leaf = 0, lane = 0;  ///< position in the tree

    static constexpr std::uint32_t none = 0xffffffffu;
    bool is_found() const { return triangle != none; }
};

/// The result equals that of a brute-force search, bit by bit; of several triangles with the same square, the one with
/// the lowest number. The point is finite. `first_leaf` is a warm start, or none.
void find_nearest(const MeshTree& tree, const Vec3& point, std::uint32_t first_leaf, NearestTriangle& nearest);

}  // namespace abut::detail
