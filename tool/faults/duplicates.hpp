#pragma once

// Finds duplicates: objects in the same position, and duplicate facets of one surface.

#include "tool/objects/level_view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace abut::tool {

/// Objects with equal surfaces in the same position.
template <int D>
struct CopyGroup {
    std::vector<std::size_t> objects;  ///< two or more, sorted
    float apart = 0;                   ///< maximum distance between corresponding vertices
    Vec<D> position{};                 ///< centre of the first object
};

/// Triangles of one mesh with the same vertices and the same orientation. Two of opposite orientation are a two-sided
/// sheet.
template <int D>
struct DuplicateFacets {
    std::size_t object = 0;   ///< first object that uses this mesh
    std::size_t objects = 1;  ///< count of objects that use it
    std::size_t count = 0;    ///< count of superfluous facets
    std::uint32_t first = 0;  ///< the first of them
    Vec<D> position{};        ///< its centre
};

template <int D>
struct Duplicates {
    std::vector<CopyGroup<D>> groups;
    std::vector<DuplicateFacets<D>> facets;
};

/// The maximum distance between corresponding vertices of two surfaces. Returns nothing if the surfaces differ by more
/// than the tolerance. The order and the orientation of facets don't matter. Surfaces with details finer than twice the
/// tolerance may count as different. Takes O(n log n) time.
template <int D>
std::optional<float> surface_distance(const Surface<D>& a, const Surface<D>& b, float tolerance);

/// Finds objects whose surfaces, or vertices if both are convex, coincide to within `tolerance` times the size of the
/// smaller one, and duplicate facets.
template <int D>
Duplicates<D> find_duplicates(const std::vector<ViewedObject<D>>& objects, float tolerance = 1e-3f);

}  // namespace abut::tool
