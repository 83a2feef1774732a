#pragma once

// Planes of faces at which a body bends inwards.

#include <abut/bake/piece.hpp>

#include <utility>
#include <vector>

namespace abut {

/// Parallel planes of one normal, by ascending offset.
using ParallelPlanes = std::pair<DVec<3>, std::vector<double>>;

/// The planes of the triangles on both sides of sharp reflex edges; of many the weightiest, by length and sharpness of
/// their edges. Nearly equal planes are one.
std::vector<ParallelPlanes> reflex_planes(const Piece& piece);

}  // namespace abut
