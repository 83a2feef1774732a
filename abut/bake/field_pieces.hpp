#pragma once

// The pieces of a surface, segments in the plane and triangles in space, as the search for the nearest of them wants
// them: eight side by side, ready to be measured, in a tree of boxes. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/large_pages.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

inline constexpr std::uint32_t piece_lanes = 8;

/// Numbers of eight pieces.
using PieceRow = std::array<double, piece_lanes>;

/// Those in lanes that are left over repeat another.
template <int D>
struct PieceLeaf;

/// Segments.
template <>
struct alignas(64) PieceLeaf<2> {
    std::array<PieceRow, 2> from, along;
    PieceRow inverse;  ///< of the length, squared
    std::array<std::uint32_t, piece_lanes> piece;
};

/// Triangles, each in a frame of its own: the first corner is the origin, the longest side lies along the first axis,
/// and the third corner is on the upper side of it.
template <>
struct alignas(64) PieceLeaf<3> {
    std::array<PieceRow, 3> corner;
    std::array<std::array<PieceRow, 3>, 3> axis;
    PieceRow length;          ///< of the longest side
    PieceRow x, y;            ///< of the third corner
    PieceRow inverse_first;   ///< of the length of the side from the first corner to the third, squared
    PieceRow inverse_second;  ///< of that from the second to the third
    std::array<std::uint32_t, piece_lanes> piece;
};

/// Around eight leaves or groups; those that there are not are infinitely far from all.
template <int D>
struct alignas(32) PieceBoxes {
    std::array<std::array<float, piece_lanes>, D> min, max;
};

template <int D>
struct PieceTree {
    std::vector<PieceLeaf<D>, LargePages<PieceLeaf<D>>> leaves;
    /// The boxes of the leaves, eight by eight; those of these groups, eight by eight; and so on to one group.
    std::vector<std::vector<PieceBoxes<D>>> levels;
    double spread = 0;  ///< no two points of the surface are farther apart
};

/// The corners of a segment or a triangle.
template <int D>
using PieceCorners = std::array<Vec<D>, D>;

/// There is at least one piece, of a length or an area above 0. O(n log n).
template <int D>
PieceTree<D> build_piece_tree(std::span<const PieceCorners<D>> pieces);

}  // namespace abut
