#pragma once

// Hulls of few corners: not the least convex set that holds the points, but nearly the least of so many corners.

#include <abut/convex/hull.hpp>
#include <abut/convex/hull_options.hpp>
#include <abut/math/linear.hpp>

#include <optional>

namespace abut {

/// As `hull`, with options. Where the hull has more corners than it may, the result isn't made of points of the input,
/// but every one of them lies in the convex hull of the result's corners, exactly, and `offsets` holds for them.
/// A Problem `too_large` where that would take corners beyond the range of floats.
Result<Hull2> limited_hull(std::span<const Vec2> points, const HullOptions& options);

/// The same in space. Points that lie in a plane stay there: then each lies in the result as seen along the axis
/// nearest to the plane's normal, exactly, and is off it by no more than those of `hull` are.
Result<Hull3> limited_hull(std::span<const Vec3> points, const HullOptions& options);

/// Around the corners of a hull with an area (as `Hull2` has them), one of at most `limit` corners, 3 or more, that
/// holds them: of no larger area than the least turned rectangle around them as `seen` shows it, up to the rounding of
/// floats; for 3 corners, than twice that. Nothing where such corners are beyond the range of floats.
std::optional<Hull2> outline_of(std::span<const Vec2> hull_points, std::size_t limit, const Affine<2>& seen);

/// What is wrong then.
inline Problem beyond_floats() {
    return {ProblemCode::too_large, "so few corners that hold all points are beyond the range of floats", 0};
}

}  // namespace abut
