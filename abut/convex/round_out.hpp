#pragma once

// From corners in double to floats, without letting go of what they hold.

#include <abut/convex/lowest_point.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace abut {

/// A point of floats near `corner` that is above, or on, every one of the planes that meet there: then whatever those
/// planes held with the corner, it holds as well. Of those around the first place on the way out that has any, the one
/// lowest above the planes; -0 becomes 0. Nothing where there is none in the range of floats. Above is up to the
/// rounding of doubles.
template <int D>
std::optional<Vec<D>> rounded_out(const DVec<D>& corner, std::span<const Plane<D>> planes);

/// Corners around all points that need no search: those of their box where `limit` allows for them, else of the simplex
/// that has the box in the corner of its legs. None where they leave the range of floats.
template <int D>
std::vector<Vec<D>> corners_of_box(std::span<const Vec<D>> points, std::size_t limit);

}  // namespace abut
