#pragma once

// What of the cells of a Grid a box overlaps, a ray touches, or is near. For .cpp files.

#include <abut/broad_phase/grid_store.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>

namespace abut {

/// The items that lie in cells; `boxes` are those of all items.
template <int D>
struct GridItems {
    const GridCells<D>& cells;
    const GridStore& store;
    const Aabb<D>* boxes;
};

/// `box` is from `usable`.
template <int D>
void find_overlapping(const GridItems<D>& items, const Aabb<D>& box, ItemCall visit);

/// Cell by cell, the one in front first.
template <int D>
void find_within(const GridItems<D>& items, const RayReach<D>& reach, ReachCall visit);

/// Ring by ring of cells, outwards.
template <int D>
void find_within(const GridItems<D>& items, const BoxReach<D>& reach, ReachCall visit);

}  // namespace abut
