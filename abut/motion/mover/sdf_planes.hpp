#pragma once

// Contact planes of a signed distance function (SDF) near a convex shape, such as a floor and a wall of one field. For
// .cpp files.
//
// part_distance finds only the closest point of such a part. A shape pressed into a corner touches two or more
// surfaces, whose closest one alternates. A sampled field also rounds its distance in corners: beside two walls,
// interpolation of min(x, y) gives about x y / cell, whose closest point is on neither wall. The zero level set itself
// is accurate, so the planes are found on it by rays.

#include <abut/convex/support.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <cstddef>
#include <span>

namespace abut::detail {

/// A contact plane of the part, at the support point of the shape along it.
template <int D>
struct SdfPlane {
    DVec<D> normal{0.0};  ///< unit normal, facing the shape
    DVec<D> point{0.0};   ///< point on the surface
    double gap = 0;       ///< distance from the shape along the normal; at least 0
};

/// Maximum number of planes.
template <int D>
inline constexpr std::size_t max_sdf_planes = D == 2 ? 8 : 26;

/// Writes the planes within `reach` of the shape, or a fifth of its size if that is more, to `planes`, and returns
/// their number. Planes with similar normals count once. All planes are found for flat surfaces whose corner angles
/// differ by 40 degrees or more; otherwise those that rays in 8 (26) directions hit.
template <int D>
std::size_t find_sdf_planes(const Convex<D>& shape, const DistanceFunction<D>& function, double reach,
                            std::span<SdfPlane<D>, max_sdf_planes<D>> planes);

/// The distance from the support point along a unit direction to the surface; infinite beyond the shape's size.
template <int D>
double distance_to_surface(const Convex<D>& shape, const DistanceFunction<D>& function, const DVec<D>& direction);

}  // namespace abut::detail
