#pragma once

// Consistent orientation of triangles.

#include <abut/math/detail/no_index.hpp>
#include <abut/shape/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// Patches: the connected components of triangles across manifold edges (edges of exactly two triangles).
struct Patches {
    std::vector<std::uint32_t> of;  ///< for each triangle: the index of its patch, ordered by first triangle
    /// For each patch: true if its triangles were oriented consistently in the input.
    std::vector<bool> was_consistent;

    std::size_t count() const { return was_consistent.size(); }
};

/// The triangle across an edge, if exactly two share it, and whether the two run along it in opposite directions.
struct AdjacentTriangle {
    std::uint32_t triangle = no_index;
    bool consistent = true;
};

/// Orients each patch consistently: the two triangles of a manifold edge run along it in opposite directions. The
/// orientation of most of a patch's area is left as it was. A non-orientable patch, such as a Moebius strip, keeps some
/// inconsistent edge. Points must be welded. O(n log n).
Patches orient_consistently(Welded& surface);
/// The variant with given adjacency: `across` holds the triangle across each half-edge 3t + k, also at non-manifold
/// edges.
Patches orient_consistently(Welded& surface, std::span<const AdjacentTriangle> across);

}  // namespace abut::detail
