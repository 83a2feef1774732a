#pragma once

// The least translation that parts two solids whose interiors overlap. For .cpp files.

#include <abut/query/detail/solid/plane_meets.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// The least move that the search finds. Moving B by depth * normal parts the interiors, exactly as these floats say.
/// Mostly no move is shorter; a pocket of moves that is small may be missed. Slivers by the thousand that share corners
/// end the search early, with a longer move: at the latest the one out of the other's box.
SeparatingMove separating_move(const View<3>& a, const View<3>& b);

}  // namespace abut::detail
