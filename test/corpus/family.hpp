#pragma once

// The families of pairs of the corpus, and how often each comes.

#include <array>
#include <cstdint>
#include <string_view>

namespace abut::corpus {

enum class Family {
    random,            ///< every kind against every kind, near one another
    coherent,          ///< small steps into and out of touching, with what the step before left in the cache
    face_face,         ///< two faces (2D: edges) with a piece in common, exactly
    edge_edge,         ///< two edges that cross (2D: two corners in one place), exactly
    vertex_face,       ///< a corner on a face (2D: on an edge), exactly
    edge_or_vertex,    ///< an edge on a face, a corner on an edge or on a corner, exactly
    lattice,           ///< a few points of a small lattice: touching in any way, crossing, flat, concentric
    parallel_faces,    ///< boxes and prisms face to face, near or in one another
    needle,            ///< 1e3 to 1e6 times as long as wide
    flake,             ///< 1e3 to 1e6 times as wide as thick
    concentric,        ///< symmetric shapes about one center
    identical,         ///< a shape and itself, or next to itself
    zero_size,         ///< boxes without thickness, capsules without length, balls without radius
    duplicate_points,  ///< hulls of points that are twice there, on a line, on circles
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

/// The pairs of the corpus in order: which family and dimension the pair of a number is of. One in fifty is round.
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
