#pragma once

// Planes of the faces at reflex edges.

#include <abut/bake/parts/piece.hpp>

#include <utility>
#include <vector>

namespace abut::detail {

/// A normal and the ascending offsets of parallel planes.
using ParallelPlanes = std::pair<DVec<3>, std::vector<double>>;

/// The planes of both triangles at sharp reflex edges, weighted by the length and sharpness of the edges. Nearly equal
/// planes are merged; the heaviest ones are returned.
std::vector<ParallelPlanes> reflex_planes(const Piece& piece);

}  // namespace abut::detail
