#pragma once

// Concavity: the distance between a convex hull and its contents, after Wei et al. (2022).

#include <abut/bake/parts/approximate_hull.hpp>
#include <abut/bake/parts/piece.hpp>

#include <array>
#include <span>
#include <vector>

namespace abut::detail {

using Corners = std::array<DVec<3>, 3>;  ///< of a triangle

/// The radius of the ball with this volume, times 0.3 to make it comparable to a distance.
double volume_as_length(double volume);

/// The inverse of `volume_as_length`.
double length_as_volume(double length);

/// The surface of an approximate hull, for measuring distances.
struct HullSurface {
    std::vector<Corners> triangles;
    std::vector<ApproximateHull::Plane> planes;  ///< empty if the hull is flat
};
HullSurface approximate_hull_surface(std::span<const DVec<3>> points, ApproximateHull& hull);

/// The search decides whether a distance exceeds `limit`, to within `precision` (above 0). The distance itself and
/// smaller ones are measured at samples only.
struct DistanceThreshold {
    double limit = 0, precision = 0;
};

/// The directed Hausdorff distance from a hull's surface to a piece's surface and caps; at least 0.
double farthest_distance(const Piece& piece, const HullSurface& surface, const DistanceThreshold& threshold);

/// The directed Hausdorff distance from a hull's surface to the union of two hulls.
double farthest_distance(const HullSurface& first, const HullSurface& second, const HullSurface& surface,
                         const DistanceThreshold& threshold);

}  // namespace abut::detail
