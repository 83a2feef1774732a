#pragma once

// The edges of triangles, and who meets at them.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// One side of a triangle. Those of triangle t are 3t, 3t + 1 and 3t + 2; side 3t + k goes from corner k to the next.
struct HalfEdge {
    std::uint32_t low = 0, high = 0;  ///< its ends, whichever way it goes
    std::uint32_t side = 0;
    bool upwards = true;  ///< from `low` to `high`

    std::pair<std::uint32_t, std::uint32_t> ends() const { return {low, high}; }
};

inline constexpr std::uint32_t no_side = std::numeric_limits<std::uint32_t>::max();

inline std::uint32_t next_side(std::uint32_t side) {
    return side % 3 == 2 ? side - 2 : side + 1;
}
inline std::uint32_t start_of(std::span<const glm::uvec3> triangles, std::uint32_t side) {
    return triangles[side / 3][static_cast<glm::length_t>(side % 3)];
}
inline std::uint32_t end_of(std::span<const glm::uvec3> triangles, std::uint32_t side) {
    return start_of(triangles, next_side(side));
}

/// Sorted by their ends, then by their sides: those of one edge stand together. Memory grows with the largest number of
/// a point; O(n) where few triangles meet at each.
std::vector<HalfEdge> sorted_half_edges(std::span<const glm::uvec3> triangles);

/// Whether some triangle has the edge.
bool has_edge(std::span<const HalfEdge> sorted, std::uint32_t a, std::uint32_t b);

/// Visits what stands together, as a span.
template <class Visit>
void each_edge(std::span<const HalfEdge> sorted, Visit visit) {
    for (std::size_t begin = 0; begin < sorted.size();) {
        std::size_t end = begin + 1;
        while (end < sorted.size() && sorted[end].ends() == sorted[begin].ends()) ++end;
        visit(sorted.subspan(begin, end - begin));
        begin = end;
    }
}

/// For each side the one that goes the other way, where exactly these two share the edge; else no_side.
std::vector<std::uint32_t> twins(std::span<const HalfEdge> sorted);

/// What is not as it is on the surface of solids.
struct EdgeFaults {
    std::size_t open = 0;         ///< edges of one triangle
    std::size_t crowded = 0;      ///< edges of more than two
    std::size_t disagreeing = 0;  ///< edges of two that go along it the same way
    bool closed = false;          ///< every edge has as many triangles one way as the other
};
EdgeFaults edge_faults(std::span<const glm::uvec3> triangles);

}  // namespace abut
