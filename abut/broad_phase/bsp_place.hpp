#pragma once

// Taking items out of the tree of a Bsp and putting them in. Not for users.

#include <abut/broad_phase/bsp_node.hpp>

namespace abut {

/// Takes item `item` out of all lists; its box is still that with which it was put in.
template <int D>
void take_out(BspTree<D>& tree, std::uint32_t item);

/// Puts item `item` into the lists of the cells that its box reaches. False where there is no room left, and then it is
/// in some of them.
template <int D>
bool put_in(BspTree<D>& tree, std::uint32_t item);

}  // namespace abut
