#pragma once

// Which plane to cut a piece by.

#include <abut/bake/piece.hpp>
#include <abut/bake/rough_hull.hpp>

#include <vector>

namespace abut {

struct RatedCut {
    CutPlane plane;
    double extra;    ///< what the hulls of both sides have beyond the piece
    double no_face;  ///< what weighs that the plane has no face of the piece in it, or a small one
    double rating;   ///< less is better: both, and a little for halves that aren't alike
};

/// The most promising planes, best first, no two nearly alike. Sweeps of parallel planes across the axes of space and
/// the main axes of the piece, those next to the best once more and closer together; levels at which it is flat; and
/// the planes of faces that meet in reflex edges, which cut what was made of boxes into these boxes.
std::vector<RatedCut> rated_cuts(const Piece& piece, RoughHull& hull, std::size_t count, int offsets_a_sweep);

/// How far from a plane points may be and still count as lying on it.
double cut_margin(const Piece& piece);

/// Of the hull as thick as the piece is.
void measure_hull(Piece& piece, RoughHull& hull);

}  // namespace abut
