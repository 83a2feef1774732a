#pragma once

// A bounding volume hierarchy of primitives: segments in 2D, triangles in 3D. Eight primitives of a leaf are stored
// side by side (SoA), with all that their distance needs precomputed. For .cpp files.

#include <abut/math/detail/large_pages.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

inline constexpr std::uint32_t primitive_lanes = 8;

/// One number for each of eight primitives.
using PrimitiveRow = std::array<double, primitive_lanes>;

/// Unused lanes repeat another primitive.
template <int D>
struct PrimitiveLeaf;

/// Eight segments.
template <>
struct alignas(64) PrimitiveLeaf<2> {
    std::array<PrimitiveRow, 2> from, along;
    PrimitiveRow inverse;  ///< 1 / squared length
    std::array<std::uint32_t, primitive_lanes> primitive;
};

/// Eight triangles, each in its own frame: the origin is the first corner, the x axis runs along the longest side, and
/// the third corner has a positive y.
template <>
struct alignas(64) PrimitiveLeaf<3> {
    std::array<PrimitiveRow, 3> corner;
    std::array<std::array<PrimitiveRow, 3>, 3> axis;
    PrimitiveRow length;          ///< of the longest side
    PrimitiveRow x, y;            ///< of the third corner
    PrimitiveRow inverse_first;   ///< 1 / squared length of the side from the first corner to the third
    PrimitiveRow inverse_second;  ///< 1 / squared length of the side from the second corner to the third
    std::array<std::uint32_t, primitive_lanes> primitive;
};

/// The boxes of eight leaves or groups. Unused boxes are infinitely far from everything.
template <int D>
struct alignas(32) PrimitiveBoxes {
    std::array<std::array<float, primitive_lanes>, D> min, max;
};

template <int D>
struct PrimitiveBvh {
    std::vector<PrimitiveLeaf<D>, LargePages<PrimitiveLeaf<D>>> leaves;
    /// The boxes of the leaves in groups of eight, then those of these groups, up to a single group.
    std::vector<std::vector<PrimitiveBoxes<D>>> levels;
    double diameter_bound = 0;  ///< upper bound of the distance between two points of the surface
};

/// The corners of a segment or a triangle.
template <int D>
using PrimitiveCorners = std::array<Vec<D>, D>;

/// Needs at least one primitive; each has a positive length or area. O(n log n).
template <int D>
PrimitiveBvh<D> build_primitive_bvh(std::span<const PrimitiveCorners<D>> primitives);

}  // namespace abut::detail
