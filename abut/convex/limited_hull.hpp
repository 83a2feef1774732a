#pragma once

// Hulls of few corners: not the least convex set that holds the points, but nearly the least of so many corners.

#include <abut/convex/hull.hpp>
#include <abut/convex/hull_options.hpp>

namespace abut {

/// As `hull`, with options. Where the hull has more corners than it may, the result isn't made of points of the input,
/// but every one of them lies in the convex hull of the result's corners, exactly, and `offsets` holds for them.
/// A Problem `too_large` where that would take corners beyond the range of floats.
Result<Hull2> limited_hull(std::span<const Vec2> points, const HullOptions& options);

/// The same in space. Points that lie in a plane stay there: then each lies in the result as seen along the axis
/// nearest to the plane's normal, exactly, and is off it by no more than those of `hull` are.
Result<Hull3> limited_hull(std::span<const Vec3> points, const HullOptions& options);

}  // namespace abut
