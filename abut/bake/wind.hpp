#pragma once

// Which way round triangles are.

#include <abut/bake/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// Triangles that hang together by edges of exactly two of them.
struct Patches {
    std::vector<std::uint32_t> of;  ///< one a triangle: the number of its patch, in the order of their first triangles
    /// One a patch: whether its triangles agreed with one another as they came.
    std::vector<bool> agreed;

    std::size_t count() const { return agreed.size(); }
};

/// Turns triangles until those that share an edge, if they are two, go along it in opposite ways, and most of a patch's
/// area stays as it was. Where that can't be done, as on a Moebius strip, some edge is left at which they don't.
/// Points are welded. O(n log n).
Patches wind_alike(Welded& surface);

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
