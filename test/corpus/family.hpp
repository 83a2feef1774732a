#pragma once

// The families of pairs of the corpus, and their frequencies.

#include <array>
#include <cstdint>
#include <string_view>

namespace abut::corpus {

enum class Family {
    random,            ///< every kind against every kind, close together
    coherent,          ///< small steps into and out of contact, with the cache of the last step
    face_face,         ///< two faces (2D: edges) that touch exactly
    edge_edge,         ///< two edges that cross exactly (2D: two coinciding vertices)
    vertex_face,       ///< a vertex exactly on a face (2D: on an edge)
    edge_or_vertex,    ///< an edge on a face, a vertex on an edge or on a vertex, exactly
    lattice,           ///< a few points of a small lattice: touching in any way, crossing, flat, concentric
    parallel_faces,    ///< boxes and prisms face to face, apart or overlapping
    needle,            ///< 1e3 to 1e6 times as long as wide
    flake,             ///< 1e3 to 1e6 times as wide as thick
    concentric,        ///< symmetric shapes about one center
    identical,         ///< a shape and itself, or a shifted copy
    zero_size,         ///< boxes without thickness, capsules without length, balls without radius
    duplicate_points,  ///< hulls of duplicate, collinear or cocircular points
    small_gap,         ///< gaps and depths of 1e-7 to 1e-3 of the size
    mixed_sizes,       ///< 1e-3 beside 1e4
    far,               ///< up to 1e6 from the origin
    half_space,        ///< a shape and the ground
    round,             ///< cylinders, cones, stretched balls and capsules
};
inline constexpr int family_count = 19;

inline constexpr std::array<std::string_view, family_count> family_names{
    "random",         "coherent",    "face_face", "edge_edge",  "vertex_face", "edge_or_vertex", "lattice",
    "parallel_faces", "needle",      "flake",     "concentric", "identical",   "zero_size",      "duplicate_points",
    "small_gap",      "mixed_sizes", "far",       "half_space", "round"};

inline std::string_view name_of(Family family) {
    return family_names[static_cast<std::size_t>(family)];
}

/// The family and dimension of the pair with a number. One in fifty is round.
struct Place {
    int dimension;
    Family family;
    std::uint64_t seed;
};
inline Place place(std::uint64_t number) {
    const std::uint64_t turn = number / 2 % 50;
    const Family family = turn == 49 ? Family::round : static_cast<Family>(turn % (family_count - 1));
    return {number % 2 == 0 ? 3 : 2, family, number};
}

}  // namespace abut::corpus
