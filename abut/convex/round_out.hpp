#pragma once

// From corners in double to floats, without letting go of what they hold.

#include <abut/convex/lowest_point.hpp>
#include <abut/convex/stretched_frame.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// A point of floats near `corner` that is above, or on, every one of the planes that meet there: then whatever those
/// planes held with the corner, it holds as well. Corner and planes are those of the frame, the point is of the world;
/// -0 becomes 0. Nothing where there is none in the range of floats. Above is up to the rounding of doubles.
template <int D>
std::optional<Vec<D>> rounded_out(const DVec<D>& corner, std::span<const Plane<D>> planes,
                                  const StretchedFrame<D>& frame);

/// Points around the unit cube of so few corners that need no search: the cube itself (of 8 corners in space, 4 in the
/// plane) or, in space, a prism of twice its volume (6), a pyramid of 2.25 times (5) or a tetrahedron of 4.5 times (4);
/// in the plane a triangle of twice its area.
template <int D>
std::vector<DVec<D>> around_unit_cube(std::size_t limit);

/// The cube, prism, tetrahedron, rectangle or triangle of those around the bounding box of the points, in floats, its
/// slanting side grown by a share of `growth`. None where they leave the range of floats.
template <int D>
std::vector<Vec<D>> corners_of_box(std::span<const Vec<D>> points, std::size_t limit, double growth);

}  // namespace abut
