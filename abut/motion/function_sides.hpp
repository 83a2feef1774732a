#pragma once

// The sides of what is known by its distance alone, near a convex shape: a floor and a wall of one field. For .cpp
// files.
//
// Of such a part, part_distance finds one place, the nearest. A shape pressed into a corner touches two sides of it or
// more, of which now one is the nearest and now another. And a field rounds off its distance in such a corner: beside
// two walls, interpolation makes of min(x, y) about x y / cell, so that the nearest place is neither wall's. The border
// itself stays where it is. So the sides are found on the border, by rays.

#include <abut/convex/support.hpp>
#include <abut/shape/distance_function.hpp>

#include <cstddef>
#include <span>

namespace abut {

/// Where a plane that faces the shape touches the border of the part, seen from the shape's lowest point over it.
template <int D>
struct FunctionSide {
    DVec<D> normal{0.0};  ///< of length 1, facing the shape
    DVec<D> point{0.0};   ///< on the border
    double gap = 0;       ///< from the shape along the normal; not below zero
};

/// So many sides are found at most.
template <int D>
inline constexpr std::size_t most_sides = D == 2 ? 8 : 26;

/// Those at most `reach` from the shape, and a fifth of its size in any case, into `sides`; their number. Of those with
/// about the same normal, one. All are found of a part that is flat around the shape, in corners between sides that
/// lean against each other by 40 degrees or more; of others, what rays in 8 (26) directions come to.
template <int D>
std::size_t find_sides(const Convex<D>& shape, const DistanceFunction<D>& function, double reach,
                       std::span<FunctionSide<D>, most_sides<D>> sides);

/// From the shape's farthest point along a direction, of length 1, how far along it the border is: infinite where that
/// is more than the shape's size.
template <int D>
double gap_to_border(const Convex<D>& shape, const DistanceFunction<D>& function, const DVec<D>& direction);

}  // namespace abut
