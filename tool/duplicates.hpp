#pragma once

// What is there twice: objects in the same place, pieces of one surface.

#include "level_view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace abut::tool {

/// Objects with the same surface in the same place.
template <int D>
struct CopyGroup {
    std::vector<std::size_t> objects;  ///< two or more, in order
    float apart = 0;                   ///< the farthest that a corner of one is from its like in another
    Vec<D> position{};                 ///< the middle of the first
};

/// Triangles of one mesh with the same corners in the same turn. Two of opposite turns are a sheet with two sides.
template <int D>
struct DoubledFacets {
    std::size_t object = 0;   ///< the first that is made of this mesh
    std::size_t objects = 1;  ///< how many there are
    std::size_t count = 0;    ///< of those too many
    std::uint32_t first = 0;  ///< the first of them
    Vec<D> position{};        ///< its middle
};

template <int D>
struct Duplicates {
    std::vector<CopyGroup<D>> groups;
    std::vector<DoubledFacets<D>> facets;
};

/// How far apart two surfaces are: the greatest distance of a corner to its like. Nothing where they aren't the same to
/// within the tolerance, whatever the order of their corners and pieces, and whichever way these turn. What is finer
/// than twice the tolerance may be taken for different. O(n log n).
template <int D>
std::optional<float> apart(const Surface<D>& a, const Surface<D>& b, float tolerance);

/// Objects whose surfaces, or of convex bodies corners, are apart by at most `tolerance` times the size of the smaller,
/// and doubled pieces.
template <int D>
Duplicates<D> find_duplicates(const std::vector<StandingObject<D>>& objects, float tolerance = 1e-3f);

}  // namespace abut::tool
