#pragma once

// Orients closed surfaces: solids outwards, cavities inwards.

#include <abut/shape/mesh/orient.hpp>

#include <cstddef>

namespace abut::detail {

struct InwardSurfaces {
    std::size_t cavities = 0, rooms = 0;
};

/// Orients each closed patch as a whole, solids outwards and cavities inwards. Returns how many face inwards.
///
/// A patch that no other contains is a solid; it is a room, and keeps its orientation, if it faced inwards and contains
/// at least two patches that faced outwards. A contained patch is a cavity if the two had opposite orientations, or if
/// one of them was not oriented consistently; otherwise both are solids, or both cavities. Patches with a boundary and
/// those of volume 0 are unchanged.
InwardSurfaces orient_outwards(Welded& surface, const Patches& patches);

}  // namespace abut::detail
