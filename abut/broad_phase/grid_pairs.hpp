#pragma once

// The pairs in the cells of a Grid. For .cpp files.

#include <abut/broad_phase/grid_store.hpp>
#include <abut/broad_phase/visit.hpp>

namespace abut {

/// Visits the pairs that are told in cells begin to end - 1; those who meet by their steps are compared exactly, by
/// their boxes. Returns false where the visitor has had enough.
template <int D>
bool visit_cells(const GridStore& store, const Aabb<D>* boxes, std::uint32_t begin, std::uint32_t end, PairsCall visit);

}  // namespace abut
