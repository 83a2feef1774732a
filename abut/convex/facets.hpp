#pragma once

// The surface of a polytope in 3D: its faces, and the edges between them.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// An edge between two faces. On the Gauss map it is the arc between their normals.
struct FacetEdge {
    std::uint32_t from, to;     ///< its point numbers, from < to
    std::uint32_t left, right;  ///< its faces: `left` runs along it from `from` to `to`, `right` the other way
};

/// Faces as loops of point numbers, counter-clockwise seen from outside.
struct Facets {
    std::span<const Vec3> normals;             ///< one a face, of length 1, outwards
    std::span<const std::uint32_t> loops;      ///< the point numbers of all faces, one after the other
    std::span<const std::uint32_t> loop_ends;  ///< one a face: where its loop ends in `loops`; it begins where the last
                                               ///< ended
    std::span<const FacetEdge> edges;          ///< each once, in the order of (from, to)
    std::span<const double> offsets{};         ///< one a face: dot(normal, p) <= offset for all points; none: not known

    /// The point numbers of one face.
    std::span<const std::uint32_t> loop(std::size_t face) const {
        const std::size_t begin = face == 0 ? 0 : loop_ends[face - 1];
        return loops.subspan(begin, loop_ends[face] - begin);
    }
};

/// The edges of a closed surface given as loops.
std::vector<FacetEdge> facet_edges(std::span<const std::uint32_t> loops, std::span<const std::uint32_t> loop_ends);

}  // namespace abut
