#include <abut/io/outlines.hpp>
#include <abut/math/predicates.hpp>

#include <limits>

namespace abut {
namespace {

// The winding number of the chain around the point, counter-clockwise positive: sums signed crossings of its segments
// with the ray from the point along +x. Sunday, "Inclusion of a point in a polygon" (2001).
int winding_number(const Chain& chain, const Vec2& point) {
    if (!chain.closed()) return 0;
    Aabb2 ahead{point, point};
    ahead.max.x = std::numeric_limits<float>::infinity();
    int winding = 0;
    each_part(chain, ahead, [&](const detail::Convex<2>&, std::uint32_t index) {
        const Segment2 s = chain.segment(index);
        const bool from_below = s.a.y <= point.y, to_below = s.b.y <= point.y;
        if (from_below && !to_below && orientation(s.a, s.b, point) > 0) ++winding;
        if (!from_below && to_below && orientation(s.a, s.b, point) < 0) --winding;
        return true;
    });
    return winding;
}

}  // namespace

Aabb2 bounds(const Outlines& outlines) {
    Aabb2 result = Aabb2::empty();
    for (const Chain& chain : outlines.chains) result = merged(result, bounds(chain));
    return result;
}

void each_part(const Outlines& outlines, const Aabb2& box, detail::PartVisitor<2> visit) {
    std::uint32_t first = 0;
    bool continues = true;
    for (const Chain& chain : outlines.chains) {
        each_part(chain, box, [&](const detail::Convex<2>& part, std::uint32_t index) {
            continues = visit(part, first + index);
            return continues;
        });
        if (!continues) return;
        first += chain.size();
    }
}

bool solid_contains(const Outlines& outlines, const Vec2& point) {
    if (outlines.rule == FillRule::none) return false;
    int winding = 0;
    for (const Chain& chain : outlines.chains) winding += winding_number(chain, point);
    return outlines.rule == FillRule::nonzero ? winding != 0 : winding % 2 != 0;
}

std::uint32_t part_neighbour(const Outlines& outlines, std::uint32_t part, std::uint32_t end) {
    std::uint32_t first = 0;
    for (const Chain& chain : outlines.chains) {
        if (part - first < chain.size()) {
            const std::uint32_t neighbour = chain.neighbour(part - first, end);
            return neighbour == no_neighbour ? no_neighbour : first + neighbour;
        }
        first += chain.size();
    }
    return no_neighbour;
}

}  // namespace abut
