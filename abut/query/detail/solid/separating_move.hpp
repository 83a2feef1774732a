#pragma once

// The least translation that parts two solids whose interiors overlap. For .cpp files.

#include <abut/query/detail/solid/plane_meets.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// The least move that the search finds. Moving B by depth * normal parts the interiors, exactly as these floats say.
/// It is never longer than the shortest one along an axis of the world or along
/// the normal of a face of either solid.
SeparatingMove separating_move(const View<3>& a, const View<3>& b);

}  // namespace abut::detail
