#pragma once

// The overlapping pairs in the cells of a Grid. For .cpp files.

#include <abut/broad_phase/grid/store.hpp>
#include <abut/broad_phase/visit.hpp>

namespace abut::detail {

/// Visits the overlapping pairs whose first common cell is in [begin, end). Pairs that the quantised bounds don't
/// decide are decided by their boxes. Returns false if the visitor stops the search.
template <int D>
bool visit_cells(const GridStore& store, const Aabb<D>* boxes, std::uint32_t begin, std::uint32_t end, PairsCall visit);

}  // namespace abut::detail
