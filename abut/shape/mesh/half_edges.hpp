#pragma once

// Half-edges of a triangle mesh: edges, their twins, and edge defects (boundary, non-manifold, inconsistent).

#include <abut/math/detail/no_index.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// A half-edge. Triangle t has half-edges 3t, 3t + 1 and 3t + 2; half-edge 3t + k goes from corner k to the next.
struct HalfEdge {
    std::uint32_t low = 0, high = 0;  ///< its end points, in ascending order
    std::uint32_t side = 0;
    bool upwards = true;  ///< true: it goes from `low` to `high`

    std::pair<std::uint32_t, std::uint32_t> ends() const { return {low, high}; }
};

inline std::uint32_t next_side(std::uint32_t side) {
    return side % 3 == 2 ? side - 2 : side + 1;
}
inline std::uint32_t start_of(std::span<const glm::uvec3> triangles, std::uint32_t side) {
    return triangles[side / 3][static_cast<glm::length_t>(side % 3)];
}
inline std::uint32_t end_of(std::span<const glm::uvec3> triangles, std::uint32_t side) {
    return start_of(triangles, next_side(side));
}

/// The half-edges sorted by their end points, then by their index, so that those of one edge are consecutive. O(n) if
/// few triangles share a point; memory grows with the largest point index.
std::vector<HalfEdge> sorted_half_edges(std::span<const glm::uvec3> triangles);

/// True if some triangle has the edge.
bool has_edge(std::span<const HalfEdge> sorted, std::uint32_t a, std::uint32_t b);

/// Visits the half-edges of each edge as a span.
template <class Visit>
void each_edge(std::span<const HalfEdge> sorted, Visit visit) {
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin + 1;
        while (end < sorted.size() && sorted[end].ends() == sorted[begin].ends()) ++end;
        visit(sorted.subspan(begin, end - begin));
        begin = end;
    }
}

/// The twin of each half-edge: the opposite half-edge, if exactly these two share the edge; else no_index.
std::vector<std::uint32_t> twins(std::span<const HalfEdge> sorted);

/// Counts of edges that a consistently oriented closed surface doesn't have.
struct EdgeFaults {
    std::size_t boundary = 0;      ///< edges of one triangle
    std::size_t non_manifold = 0;  ///< edges of more than two triangles
    std::size_t inconsistent = 0;  ///< edges of two triangles that run along it in the same direction
    bool closed = false;           ///< every edge has equally many triangles in both directions
};
EdgeFaults edge_faults(std::span<const glm::uvec3> triangles);

}  // namespace abut::detail
