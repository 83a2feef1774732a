#pragma once

#include <cstdint>

namespace abut {

/// Options of `Polygon::build` and `Polyhedron::build`.
struct HullOptions {
    /// The maximum number of vertices; 0: no limit. A limit below 3 in 2D or 4 in 3D is a Problem (`bad_argument`).
    /// From 8 on (4 in 2D) the result is no larger than the minimum oriented box of the points, to the rounding of
    /// floats. With 6 it is at most twice that, with 5 2.25 and with 4 4.5 times; with 3 in 2D twice.
    std::uint32_t max_vertices = 0;
    /// Receives the volume that the limit added (in 2D the area; for flat sets in 3D the area of both sides); exactly 0
    /// if the limit wasn't needed.
    double* added = nullptr;
};

}  // namespace abut
