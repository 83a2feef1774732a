#pragma once

// Passages that are too narrow: light gets through, the character doesn't.
//
// Two points of surfaces that face one another make a neck where the open ball with them as its diameter has no surface
// in it, which is where their distance can't be made less by sliding them a little, and where its middle is free: in
// front of what is near, in no filled object, not under the back of a surface. Necks that are shifts of one another, as
// between two walls, are one, in the middle of them all.
//
// A neck is a passage if light gets through, straight but for following the middle of the passage as it bends: from its
// middle there is a way across the neck on which, in both directions, nothing is in the way and the passage gets no
// narrower until it is at least `width` wide. So the bottom of a crack, a niche and the angle of a corner are none.
//
// Of passages whose middles see one another and are closer than `width` the narrowest is told.
//
// Not found: openings with three or five corners where no two points face one another; narrow turns behind which
// no place is `width` wide within 256 steps of half a neck's width along the middle count as passages.

#include "facet_tree.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace abut::tool {

template <int D>
struct GapOptions {
    double width = 0;                          ///< passages narrower than this are told
    double least = 0;                          ///< and wider than this: what is as narrow is a seam
    std::optional<DVec<D>> up = std::nullopt;  ///< where to look for the backs of grounds; of length 1
    std::function<bool(std::size_t, std::size_t)> wanted = nullptr;  ///< of which objects; all by default
};

template <int D>
struct Gap {
    std::size_t a = 0, b = 0;  ///< objects; a <= b
    float width = 0;           ///< at its narrowest
    Vec<D> position{};         ///< the middle there
    Vec<D> on_a{}, on_b{};     ///< the ends
};

/// Sorted by objects, the narrowest first. Looks at all pairs of facets closer than `width`.
template <int D>
std::vector<Gap<D>> find_gaps(const FacetTree<D>& facets, const GapOptions<D>& options);

}  // namespace abut::tool
