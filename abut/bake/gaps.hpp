#pragma once

// How far a convex hull is from what it is the hull of: the concavity of Wei et al. (2022).

#include <abut/bake/piece.hpp>
#include <abut/bake/rough_hull.hpp>

#include <array>
#include <span>
#include <vector>

namespace abut {

using Corners = std::array<DVec<3>, 3>;  ///< of a triangle

/// The radius of the ball of that volume, times 0.3, which makes it comparable to a distance.
double volume_as_length(double volume);

/// The volume of which that is the length.
double length_as_volume(double length);

/// The surface of a hull, near enough to measure by.
struct HullSides {
    std::vector<Corners> triangles;
    std::vector<RoughHull::Plane> planes;  ///< none where it is flat
};
HullSides coarse_sides(std::span<const DVec<3>> points, RoughHull& hull);

/// Whether anything is farther than `enough` is found out to within `precision`, above 0; how far it is, and what is
/// nearer, is measured at samples.
struct GapSearch {
    double enough = 0, precision = 0;
};

/// The farthest of points all over the sides from the piece's surface and caps; from 0 on.
double farthest_from(const Piece& piece, const HullSides& sides, const GapSearch& search);

/// The farthest of points all over the sides from both hulls.
double farthest_from(const HullSides& first, const HullSides& second, const HullSides& sides, const GapSearch& search);

}  // namespace abut
