#pragma once

// The surface of a polytope in 3D: its faces, and the edges between them.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// An edge between two faces; the arc between their normals on the Gauss map.
struct FacetEdge {
    std::uint32_t from, to;  ///< its vertex numbers, from < to
    std::uint32_t left,
        right;  ///< its faces: `left` runs along it from `from` to `to`, `right` in the opposite direction
};

/// Faces as loops of vertex numbers, counter-clockwise seen from outside.
struct Facets {
    std::span<const Vec3> normals;         ///< one per face, of length 1, outwards
    std::span<const std::uint32_t> loops;  ///< the vertex numbers of all faces, one after the other
    std::span<const std::uint32_t>
        loop_ends;                      ///< one per face: the end of its loop in `loops`, where the next loop begins
    std::span<const FacetEdge> edges;   ///< each once, sorted by (from, to)
    std::span<const double> offsets{};  ///< one per face: dot(normal, p) <= offset for all points; empty: unknown

    /// The vertex numbers of one face.
    std::span<const std::uint32_t> loop(std::size_t face) const {
        const std::size_t begin = face == 0 ? 0 : loop_ends[face - 1];
        return loops.subspan(begin, loop_ends[face] - begin);
    }
};

/// The edges of a closed surface of loops.
std::vector<FacetEdge> facet_edges(std::span<const std::uint32_t> loops, std::span<const std::uint32_t> loop_ends);

}  // namespace abut::detail
