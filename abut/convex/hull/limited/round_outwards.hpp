#pragma once

// Rounds corners in double to floats, outwards.

#include <abut/convex/hull/limited/linear_program.hpp>
#include <abut/convex/hull/limited/stretched_frame.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace abut::detail {

/// A float point near `corner` that is above, or on, all planes of the corner. Then it contains all that the planes and
/// the corner contain. Corner and planes are in the frame, the point is in the world; -0 becomes 0. Nothing if there is
/// none in the range of floats. Above is meant to the rounding of doubles.
template <int D>
std::optional<Vec<D>> rounded_corner(const DVec<D>& corner, std::span<const Plane<D>> planes,
                                     const StretchedFrame<D>& frame);

/// Corners around the unit cube, for each limit below 9 without a search: the cube itself (8 corners in 3D, 4 in 2D)
/// or, in 3D, a prism of twice its volume (6), a pyramid of 2.25 times (5) or a tetrahedron of 4.5 times (4); in 2D a
/// triangle of twice its area.
template <int D>
std::vector<DVec<D>> around_unit_cube(std::size_t limit);

/// The cube, prism, tetrahedron, rectangle or triangle around the bounding box of the points, in floats, with its
/// slanted side scaled by 1 + `growth`. None if they leave the range of floats.
template <int D>
std::vector<Vec<D>> corners_of_box(std::span<const Vec<D>> points, std::size_t limit, double growth);

}  // namespace abut::detail
