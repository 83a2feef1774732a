#pragma once

// Candidate planes for cutting a piece, with a rating.

#include <abut/bake/parts/approximate_hull.hpp>
#include <abut/bake/parts/piece.hpp>

#include <vector>

namespace abut::detail {

struct RatedCut {
    CutPlane plane;
    double excess_volume;  ///< volume of the two sides' hulls minus that of the piece
    double missing_face;   ///< penalty for a plane without a large coplanar face of the piece
    double rating;         ///< smaller is better: the sum of both, and a small penalty for unequal volumes
};

/// The best `count` planes, best first, no two similar. Candidates are parallel planes across the coordinate axes and
/// the principal axes of the piece, refined next to the best ones; the heights of level faces; and the planes of faces
/// at reflex edges, which separate unions of boxes.
std::vector<RatedCut> best_cuts(const Piece& piece, ApproximateHull& hull, std::size_t count, int offsets_a_sweep);

/// The distance from a plane within which points count as lying on it.
double cut_tolerance(const Piece& piece);

/// Measures the volume of the piece's hull. An open piece's hull is as thick as the piece.
void measure_hull(Piece& piece, ApproximateHull& hull);

}  // namespace abut::detail
