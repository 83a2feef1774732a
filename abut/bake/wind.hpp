#pragma once

// Which way round solids are.

#include <abut/shape/wind_alike.hpp>

#include <cstddef>

namespace abut {

struct Insides {
    std::size_t cavities = 0, rooms = 0;
};

/// Turns closed patches as a whole, so that solids are seen from outside, cavities from inside. What is in no other is
/// a solid; but where it came seen from inside and holds two or more that came seen from outside, it is a room, and
/// stays one. What is inside of another is a cavity of it where the two were wound in opposite ways, or where the
/// triangles of either didn't agree; else both are solids, or both cavities. Patches with a border, and those whose
/// volume is 0, stay as they are. Returns how many face inwards.
Insides face_outwards(Welded& surface, const Patches& patches);

}  // namespace abut
