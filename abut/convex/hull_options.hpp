#pragma once

#include <cstdint>

namespace abut {

/// What a hull is asked for beyond holding its points: see `Polygon::build` and `Polyhedron::build`.
struct HullOptions {
    /// The most corners it may have; 0: no limit. Else at least 3 in the plane and 4 in space, or it is a Problem
    /// (`bad_argument`). From 8 on (4 in the plane) the result is no larger than the least turned box around the
    /// points, with 6 twice that, with 5 2.25 and with 4 4.5 times, with 3 in the plane twice; but for rounding to
    /// floats.
    std::uint32_t max_vertices = 0;
    /// Where to tell the volume (in the plane the area; of what is flat in space the area of both sides) that the limit
    /// added; exactly 0 where it wasn't needed.
    double* added = nullptr;
};

}  // namespace abut
