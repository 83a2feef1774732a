// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs. Products
// and sums are rounded one by one in all of them, and the least of some numbers doesn't depend on the order in which
// they are compared.

#include <abut/convex/side_gaps.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/side_gaps.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each kind.
#include <abut/convex/side_lanes-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using namespace rows_of_sides;

/// Keeps all gaps, and lane by lane the widest.
struct Widest {
    HWY_ALIGN double gaps[most_sides];
    Vector widest;

    HWY_INLINE Widest() : widest(hn::Set(d, -1e300)) {}
    HWY_INLINE void visit(Vector gap, Vector, Vector, std::size_t i) {
        hn::Store(gap, d, gaps + i);
        widest = hn::Max(widest, gap);
    }
};

/// The widest gap, and the first side that has it. A structure would be read as a whole after it was written in parts,
/// for which machines have to wait.
double widest_of(const Sides& sides, const Points& points, std::uint32_t count, std::uint32_t& side) {
    Widest found;
    tell_gaps(sides, points, count, found);
    side = first_of(found.gaps, sides.room, hn::MaxOfLanes(d, found.widest));
    return found.gaps[side];
}

void widest_gap_of_two(const Sides& a, const Sides& b, const Rigid2 (&seen)[2], double enough, double doubt,
                       SideGap& result) {
    Points points[2];  // of B as seen from A, of A as seen from B
    place(b, seen[0], points[0]);
    std::uint32_t of = 0, side = 0;
    double gap = widest_of(a, points[0], b.count, side);
    if (!(gap > enough)) {
        place(a, seen[1], points[1]);
        std::uint32_t other_side = 0;
        const double other = widest_of(b, points[1], a.count, other_side);
        of = other > gap + doubt ? 1 : 0;
        gap = of == 1 ? other : gap;
        side = of == 1 ? other_side : side;
    }
    const Sides& reference = of == 0 ? a : b;
    result.gap = gap;
    result.of = of;
    result.side = side;
    result.corner = lowest(points[of], (of == 0 ? b : a).room, reference.normal_x[side], reference.normal_y[side]);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(widest_gap_of_two);

namespace {

/// Of a box, the side towards a place, and the gap before it, of something that reaches so far along the axes. By
/// arithmetic: which side it is can't be guessed.
double gap_before_box(const DVec<2>& half, const DVec<2>& place, double reach_x, double reach_y, std::uint32_t& side) {
    const double gap_x = std::abs(place.x) - half.x - reach_x;
    const double gap_y = std::abs(place.y) - half.y - reach_y;
    const std::uint32_t along_x = gap_x > gap_y ? 1 : 0;
    const std::uint32_t back_x = place.x < 0 ? 1 : 0, back_y = place.y < 0 ? 1 : 0;
    static constexpr std::uint32_t sides[8] = {0, 2, 0, 2, 3, 3, 1, 1};
    side = sides[along_x << 2 | back_x << 1 | back_y];
    return std::max(gap_x, gap_y);
}

}  // namespace

void gap_of_boxes(const DVec<2>& a, const DVec<2>& b, const Rigid2 (&seen)[2], double doubt, SideGap& result) {
    const double cos = std::abs(seen[0].cos), sin = std::abs(seen[0].sin);
    std::uint32_t sides[2];
    const double gap =
        gap_before_box(a, {seen[0].x, seen[0].y}, cos * b.x + sin * b.y, sin * b.x + cos * b.y, sides[0]);
    const double other =
        gap_before_box(b, {seen[1].x, seen[1].y}, cos * a.x + sin * a.y, sin * a.x + cos * a.y, sides[1]);
    const std::uint32_t of = other > gap + doubt ? 1 : 0;
    result.gap = of == 1 ? other : gap;
    result.of = of;
    result.side = sides[of];
    // The other's lowest corner is that of the quadrant that the normal comes from.
    static constexpr double normals[4][2] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const DVec<2> up = seen[1 - of].vector({normals[sides[of]][0], normals[sides[of]][1]});
    static constexpr std::uint32_t corners[4] = {0, 3, 1, 2};
    result.corner = corners[(up.x > 0 ? 2u : 0u) | (up.y > 0 ? 1u : 0u)];
}

void widest_gap(const Sides& a, const Sides& b, const Rigid2 (&seen)[2], double enough, double doubt, SideGap& result) {
    if (a.numbering == Numbering::box && b.numbering == Numbering::box)
        return gap_of_boxes({a.offset[1], a.offset[0]}, {b.offset[1], b.offset[0]}, seen, doubt, result);
    HWY_DYNAMIC_DISPATCH(widest_gap_of_two)(a, b, seen, enough, doubt, result);
}

}  // namespace abut
#endif
