#pragma once

// Ray casts against a convex set in closed form: polygons, polyhedra and boxes by clipping the line with their planes;
// balls, capsules and discs by quadratics; segments and triangles by their line or plane.
// Cyrus, Beck, "Generalized two- and three-dimensional clipping" (1978); Moeller, Trumbore, "Fast, minimum storage
// ray-triangle intersection" (1997).
//
// A closed form answers only if it is certain. Rays that start on, in or near the set, graze it, or hit a nearly flat
// set are left to an iterative search. For .cpp files.

#include <abut/convex/feature.hpp>
#include <abut/convex/support.hpp>

#include <array>

namespace abut::detail {

/// A ray in double.
template <int D>
struct DRay {
    DVec<D> origin;
    DVec<D> direction;  ///< of length 1 in the world, or 0; of any length in a shape's own frame
    double length;      ///< in lengths of `direction`

    DVec<D> at(double along) const { return origin + direction * along; }
    /// Whether the direction is zero.
    bool rests() const { return direction == DVec<D>(0.0); }
};

enum class RayAnswer : std::uint8_t { undecided, misses, enters };

template <int D>
struct RayEntry {
    RayAnswer answer = RayAnswer::undecided;
    double along = 0;     ///< in lengths of the direction, more than 0
    DVec<D> normal{0.0};  ///< of any length, outwards, against the direction
    FeatureKind kind = FeatureKind::none;
    std::uint32_t index = 0;
};

/// The entry of a ray from outside into the placed set. It misses no ray that goes deeper in than rounding explains.
/// The entry lies on the surface to within some billionths of the distance and the size (for a polyhedron, to the
/// flatness of its faces). With `more_radius`, the entry into all points within that of the set.
template <int D>
RayEntry<D> ray_entry(const Convex<D>& convex, const DRay<D>& ray, double more_radius = 0);

/// The entry into all points within `radius` of the sum of a segment from -half to half and of a segment or triangle,
/// whose corners are relative to the ray's origin: the impact of a moving capsule. The feature is that of the segment
/// or triangle; `part` is the place of the contact on the moving segment, from -1 to 1.
RayEntry<3> enter_rounded_sum(const DRay<3>& ray, const std::array<DVec<3>, 3>& corners, std::uint32_t count,
                              const DVec<3>& half, double radius, double& part);

}  // namespace abut::detail
