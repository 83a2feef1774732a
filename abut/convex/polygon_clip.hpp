#pragma once

// The overlap of two polygons of few sides: the smaller one is cut with the lines of the larger one's sides, on the
// stack.

#include <abut/convex/polygon_pair.hpp>

namespace abut {

/// Corners in the world, counter-clockwise; some of them may be in one place, or on a line.
struct ClippedLoop {
    std::array<DVec<2>, std::size_t{2} * most_sides> points;
    std::size_t count = 0;
};

/// False where one of them has no area to speak of: cut in another way. Corners of the one that is cut stay as they
/// are; those within the rounding of doubles of a line lie on it.
bool clip_polygons(const PolygonPair& pair, ClippedLoop& loop);

}  // namespace abut
