#pragma once

// The least translation that parts two solids whose interiors overlap. For .cpp files.

#include <abut/query/detail/solid/placed_solid.hpp>

namespace abut::detail {

/// Moving B by depth * normal parts the interiors, exactly as these floats say.
struct SeparatingMove {
    Vec3 normal{1, 0, 0};  ///< of length 1 up to rounding
    float depth = 0;
};

/// The least move that the search finds. It is never longer than the shortest one along an axis of the world or along
/// the normal of a face of either solid.
SeparatingMove separating_move(const View<3>& a, const View<3>& b);

}  // namespace abut::detail
