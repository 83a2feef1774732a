#pragma once

// Which way round triangles are: neighbours made to agree.

#include <abut/shape/weld.hpp>

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

/// The other side of an edge that two triangles share, if there are two that do; and whether they go along it in
/// opposite ways.
struct AcrossEdge {
    static constexpr std::uint32_t none = 0xffffffffu;

    std::uint32_t triangle = none;
    bool agrees = true;
};

/// Turns triangles until those that share an edge, if they are two, go along it in opposite ways, and most of a patch's
/// area stays as it was. Where that can't be done, as on a Moebius strip, some edge is left at which they don't.
/// Points are welded. O(n log n).
Patches wind_alike(Welded& surface);
/// The same where it is told, of each of the sides 3t, 3t + 1 and 3t + 2 of triangles t, what is across: also at edges
/// of more than two triangles.
Patches wind_alike(Welded& surface, std::span<const AcrossEdge> across);

}  // namespace abut
