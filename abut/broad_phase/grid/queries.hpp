#pragma once

// The overlapping pairs in the cells of a Grid, and the items that a box overlaps, that a ray touches, or that are near
// a box. For .cpp files.

#include <abut/broad_phase/grid/store.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>

namespace abut::detail {

/// Visits the overlapping pairs whose first common cell is in [begin, end). Pairs that the quantised bounds don't
/// decide are decided by their boxes. Returns false if the visitor stops the search.
template <int D>
bool visit_cells(const GridStore& store, const Aabb<D>* boxes, std::uint32_t begin, std::uint32_t end, PairsCall visit);

/// The cells, their contents, and the boxes of all items.
template <int D>
struct GridItems {
    const GridCells<D>& cells;
    const GridStore& store;
    const Aabb<D>* boxes;
};

/// Requires a box from `usable`.
template <int D>
void find_overlapping(const GridItems<D>& items, const Aabb<D>& box, ItemCall visit);

/// Visits the cells along the ray, front to back.
template <int D>
void find_within(const GridItems<D>& items, const RayReach<D>& reach, ReachCall visit);

/// Visits rings of cells around the box, from the inside out.
template <int D>
void find_within(const GridItems<D>& items, const BoxReach<D>& reach, ReachCall visit);

}  // namespace abut::detail
