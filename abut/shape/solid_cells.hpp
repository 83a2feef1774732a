#pragma once

// What is solid in a tree, cut into convex cells. For .cpp files.

#include <abut/shape/solid_tree.hpp>

namespace abut {

/// A part for each subtree that is solid throughout, numbered from 0 as the tree has them, back before front. Solid
/// that goes on without end is cut off where it is farther from all faces than their bounds are wide. Corners no
/// farther from a plane than `margin` are on it.
template <int D>
void add_cells(SolidTree<D>& tree, double margin);

}  // namespace abut
