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

    const DVec<3>& axis(int i) const { return axes[static_cast<std::size_t>(i)]; }
    double volume() const;

    /// The place of a point in the box, from 0 to 1 along each axis, and the inverse.
    DVec<3> share(const DVec<3>& point) const;
    DVec<3> at(const DVec<3>& share) const;
};

/// The direction of the edge of a convex loop (counter-clockwise, 3 corners or more) along which the bounding rectangle
/// is smallest, by rotating calipers (Toussaint 1983).
DVec<2> minimum_rectangle(std::span<const DVec<2>> loop);

/// The indices of the corners of the points' hull seen along an axis of their box, counter-clockwise in the plane of
/// the two next axes. The hull is computed in floats, with each direction scaled to its extent. Fewer than three if the
/// points are nearly collinear.
std::vector<std::uint32_t> silhouette(std::span<const DVec<3>> points, const OrientedBox& box, int up);

/// Starts from boxes around `approximate`, a few points whose hull contains the others, with a face orthogonal to each
/// of the normals. The best of them, now around the points, rotates about one axis after the other to the minimum
/// rectangle of the silhouette, until the volume stays. There is at least one normal, of length 1; the points have a
/// volume.
OrientedBox minimum_box(std::span<const DVec<3>> points, std::span<const DVec<3>> approximate,
                        std::span<const DVec<3>> normals);

}  // namespace abut::detail
