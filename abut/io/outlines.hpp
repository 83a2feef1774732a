#pragma once

// Several lines as one shape, and what they enclose together: a body with holes.

#include <abut/shape/chain.hpp>

#include <cstdint>
#include <vector>

namespace abut {

/// What lies inside of lines that go around one another. As SVG has it:
/// https://www.w3.org/TR/SVG2/painting.html#FillRuleProperty
enum class FillRule : std::uint8_t {
    none,      ///< nothing: they are lines
    nonzero,   ///< what they wind around, taken together, other than zero times: a hole goes round the other way
    even_odd,  ///< what they wind around an odd number of times
};

/// The union of some chains. Its parts are their segments, numbered on from chain to chain. Only `contains` takes what
/// they enclose as solid, by the rule; open chains enclose nothing.
struct Outlines {
    std::vector<Chain> chains;  ///< at least one
    FillRule rule = FillRule::none;
};

Aabb2 bounds(const Outlines& outlines);

/// Visits the segments whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const Outlines& outlines, const Aabb2& box, PartVisitor<2> visit);

/// Whether the point is inside by the rule, decided exactly.
bool solid_contains(const Outlines& outlines, const Vec2& point);

/// The segment that goes on at an end: 0, before the segment, 1, after it.
std::uint32_t part_neighbour(const Outlines& outlines, std::uint32_t part, std::uint32_t end);

}  // namespace abut
