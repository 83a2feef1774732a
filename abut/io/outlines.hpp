#pragma once

// Several chains as one shape, with a fill rule for the area they enclose: a polygon with holes.

#include <abut/shape/chain.hpp>

#include <cstdint>
#include <vector>

namespace abut {

/// Decides by winding numbers which area the chains enclose, as in SVG:
/// https://www.w3.org/TR/SVG2/painting.html#FillRuleProperty
enum class FillRule : std::uint8_t {
    none,      ///< no area: the chains are lines
    nonzero,   ///< points with a nonzero sum of winding numbers: a hole winds in the other direction
    even_odd,  ///< points with an odd sum of winding numbers
};

/// A union of chains. The parts are the segments, numbered consecutively from chain to chain. Only `contains` treats
/// the area enclosed by the fill rule as solid. Open chains enclose nothing.
struct Outlines {
    std::vector<Chain> chains;  ///< at least one
    FillRule rule = FillRule::none;
};

Aabb2 bounds(const Outlines& outlines);

/// Visits the segments whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const Outlines& outlines, const Aabb2& box, detail::PartVisitor<2> visit);

/// True if the point is inside by the fill rule. Decided exactly.
bool solid_contains(const Outlines& outlines, const Vec2& point);

/// The neighbouring segment at an end of a segment: `end` 0 is the start of the segment, 1 its end.
std::uint32_t part_neighbour(const Outlines& outlines, std::uint32_t part, std::uint32_t end);

}  // namespace abut
