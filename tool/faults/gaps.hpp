#pragma once

// Finds passages that are too narrow for a character, though light passes through.
//
// A neck is a segment between two surface points that face each other. Its open diametral ball contains no surface, so
// that its length is a local minimum. Its midpoint is free: in front of the nearby surfaces, in no filled object, and
// not below the back of a surface. Necks that are translates of one another, as between two walls, count as one neck at
// their common midpoint.
//
// A neck is a passage if light passes through it, following the middle of the passage as it bends. There must be a
// direction across the neck for which, both ways, nothing is in the way and the passage gets no narrower until it is at
// least `width` wide. The bottom of a crack, a niche and the angle of a corner are therefore no passages.
//
// Where a character walks from the spawns, only passages count that it gets to and that have room for it upright:
// their walls stand beside each other, nothing is above the neck at its height, and it reaches one of the two ends at
// which the passage is `width` wide. A passage under a chair or in a crate is therefore none. If it reaches both ends,
// the passage cuts nothing off.
//
// If the midpoints of several passages see each other and are closer than `width`, only the narrowest is reported.
//
// Limits: openings with three or five corners where no two points face each other are not found. Narrow bends without a
// place of the given width within 256 steps of half a neck's width count as passages.

#include "tool/faults/walkable.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace abut::tool {

template <int D>
struct GapOptions {
    double width = 0;                          ///< passages narrower than this are reported
    double min_width = 0;                      ///< and wider than this: narrower gaps are seams
    std::optional<DVec<D>> up = std::nullopt;  ///< unit vector towards which backs of grounds are searched
    std::function<bool(std::size_t, std::size_t)> is_selected = nullptr;  ///< filter of object pairs; all by default
    const Walkable<D>* walkable = nullptr;  ///< only passages that a character gets to; null: all
};

template <int D>
struct Gap {
    std::size_t a = 0, b = 0;  ///< objects; a <= b
    float width = 0;           ///< minimum width
    Vec<D> position{};         ///< midpoint of the neck
    Vec<D> on_a{}, on_b{};     ///< end points of the neck
    bool is_detour = false;    ///< a walking character gets to both ends of the passage by another way
};

/// Finds all passages, sorted by objects, the narrowest first. Tests all pairs of facets closer than `width`.
template <int D>
std::vector<Gap<D>> find_gaps(const FacetTree<D>& facets, const GapOptions<D>& options);

}  // namespace abut::tool
