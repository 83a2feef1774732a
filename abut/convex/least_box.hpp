#pragma once

// Nearly the least turned box around points.

#include <abut/math/vec.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// All p with low[i] <= dot(axes[i], p) <= high[i]; the axes have length 1 and are at right angles.
struct TurnedBox {
    std::array<DVec<3>, 3> axes;
    DVec<3> low, high;

    double volume() const;
};

/// The direction of that edge of a convex loop (counter-clockwise, 3 corners or more) along which the rectangle around
/// the loop is least, by rotating calipers (Toussaint 1983).
DVec<2> least_rectangle(std::span<const DVec<2>> loop);

/// The numbers of the corners of the points' hull as seen along the axis at right angles to `right` and `ahead`,
/// counter-clockwise: decided on floats, each of the two directions scaled to its own extent. Fewer than three where
/// the points are nearly in a line.
std::vector<std::uint32_t> silhouette(std::span<const DVec<3>> points, const DVec<3>& right, const DVec<3>& ahead);

/// Tried are boxes around `rough`, some few points that hold the others, with a side across each of the normals. The
/// best of them, now around the points, then turn about one axis after the other to where the rectangle around the
/// silhouette is least, until that gains nothing. There is at least one normal, of length 1; the points have a volume.
TurnedBox least_box(std::span<const DVec<3>> points, std::span<const DVec<3>> rough, std::span<const DVec<3>> normals);

}  // namespace abut
