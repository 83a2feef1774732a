#pragma once

// Convex cells of the solid part of a tree. For .cpp files.

#include <abut/shape/solid_bsp/tree.hpp>

namespace abut::detail {

/// Adds a part for each subtree that is entirely solid, numbered from 0 in tree order, back before front. An unbounded
/// solid is clipped at the width of the faces' bounds beyond them. Vertices within `margin` of a plane are on it.
template <int D>
void add_cells(SolidTree<D>& tree, double margin);

}  // namespace abut::detail
