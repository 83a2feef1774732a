#pragma once

// A nearly minimum oriented bounding box of points.

#include <abut/math/vec.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// All p with low[i] <= dot(axes[i], p) <= high[i]; the axes are orthonormal.
struct OrientedBox {
    std::array<DVec<3>, 3> axes;
    DVec<3> low, high;

    double volume() const;
};

/// The direction of the edge of a convex loop (counter-clockwise, 3 corners or more) along which the bounding rectangle
/// is smallest, by rotating calipers (Toussaint 1983).
DVec<2> minimum_rectangle(std::span<const DVec<2>> loop);

/// The indices of the corners of the points' hull in the projection onto `right` and `ahead`, counter-clockwise. The
/// hull is computed in floats, with each direction scaled to its extent. Fewer than three if the points are nearly
/// collinear.
std::vector<std::uint32_t> silhouette(std::span<const DVec<3>> points, const DVec<3>& right, const DVec<3>& ahead);

/// Starts from boxes around `approximate`, a few points whose hull contains the others, with a face orthogonal to each
/// of the normals. The best of them, now around the points, rotates about one axis after the other to the minimum
/// rectangle of the silhouette, until the volume stays. There is at least one normal, of length 1; the points have a
/// volume.
OrientedBox minimum_box(std::span<const DVec<3>> points, std::span<const DVec<3>> approximate,
                        std::span<const DVec<3>> normals);

}  // namespace abut::detail
