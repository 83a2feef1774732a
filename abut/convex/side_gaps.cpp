// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs. Products
// and sums are rounded one by one in all of them, and the least of some numbers doesn't depend on the order in which
// they are compared.

#include <abut/convex/side_gaps.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/side_gaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, side_lanes>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes d;
constexpr std::size_t lanes = hn::MaxLanes(d);

/// Rows of numbers, as long as the rows of Sides.
struct Points {
    HWY_ALIGN double x[most_sides];
    HWY_ALIGN double y[most_sides];
};

void place(const Sides& sides, const Rigid2& seen, Points& points) {
    const Vector cos = hn::Set(d, seen.cos), sin = hn::Set(d, seen.sin);
    const Vector offset_x = hn::Set(d, seen.x), offset_y = hn::Set(d, seen.y);
    for (std::size_t i = 0; i < sides.room; i += lanes) {
        const Vector x = hn::LoadU(d, sides.x + i), y = hn::LoadU(d, sides.y + i);
        hn::Store(hn::Add(hn::Sub(hn::Mul(cos, x), hn::Mul(sin, y)), offset_x), d, points.x + i);
        hn::Store(hn::Add(hn::Add(hn::Mul(sin, x), hn::Mul(cos, y)), offset_y), d, points.y + i);
    }
}

/// Of `groups` vectors of sides, from `first` on, the gaps in front of them; returns the widest, lane by lane.
template <std::size_t groups>
Vector gaps_of(const Sides& sides, std::size_t first, const double* x, const double* y, std::uint32_t count,
               double* gaps) {
    Vector normal_x[groups], normal_y[groups], least[groups];
    const Vector x0 = hn::Set(d, x[0]), y0 = hn::Set(d, y[0]);
    for (std::size_t g = 0; g < groups; ++g) {
        normal_x[g] = hn::LoadU(d, sides.normal_x + first + g * lanes);
        normal_y[g] = hn::LoadU(d, sides.normal_y + first + g * lanes);
        least[g] = hn::Add(hn::Mul(normal_x[g], x0), hn::Mul(normal_y[g], y0));
    }
    for (std::uint32_t k = 1; k < count; ++k) {
        const Vector xk = hn::Set(d, x[k]), yk = hn::Set(d, y[k]);
        for (std::size_t g = 0; g < groups; ++g)
            least[g] = hn::Min(least[g], hn::Add(hn::Mul(normal_x[g], xk), hn::Mul(normal_y[g], yk)));
    }
    Vector widest = hn::Set(d, -1e300);
    for (std::size_t g = 0; g < groups; ++g) {
        const Vector gap = hn::Sub(least[g], hn::LoadU(d, sides.offset + first + g * lanes));
        hn::Store(gap, d, gaps + first + g * lanes);
        widest = hn::Max(widest, gap);
    }
    return widest;
}

/// The first of the numbers that equals the largest or least of them, which is in every lane of `value`.
std::uint32_t first_of(const double* numbers, std::size_t room, Vector value) {
    for (std::size_t i = 0; i < room; i += lanes) {
        const auto same = hn::Eq(hn::Load(d, numbers + i), value);
        if (!hn::AllFalse(d, same))
            return static_cast<std::uint32_t>(i + static_cast<std::size_t>(hn::FindFirstTrue(d, same)));
    }
    return 0;
}

/// The widest gap, and the first side that has it. A structure would be read as a whole after it was written in parts,
/// for which machines have to wait.
double widest_of(const Sides& sides, const double* x, const double* y, std::uint32_t count, std::uint32_t& side) {
    HWY_ALIGN double gaps[most_sides];
    const bool many = sides.room >= 8;
    Vector widest =
        many ? gaps_of<8 / lanes>(sides, 0, x, y, count, gaps) : gaps_of<4 / lanes>(sides, 0, x, y, count, gaps);
    for (std::size_t first = 8; first < sides.room; first += 4)
        widest = hn::Max(widest, gaps_of<4 / lanes>(sides, first, x, y, count, gaps));
    side = first_of(gaps, sides.room, hn::MaxOfLanes(d, widest));
    return gaps[side];
}

std::uint32_t lowest(const Points& points, std::size_t room, double normal_x, double normal_y) {
    HWY_ALIGN double heights[most_sides];
    const Vector x = hn::Set(d, normal_x), y = hn::Set(d, normal_y);
    Vector least = hn::Set(d, 1e300);
    for (std::size_t i = 0; i < room; i += lanes) {
        const Vector height = hn::Add(hn::Mul(x, hn::Load(d, points.x + i)), hn::Mul(y, hn::Load(d, points.y + i)));
        hn::Store(height, d, heights + i);
        least = hn::Min(least, height);
    }
    return first_of(heights, room, hn::MinOfLanes(d, least));
}

void widest_gap_of_two(const Sides& a, const Sides& b, const Rigid2 (&seen)[2], double enough, double doubt,
                       SideGap& result) {
    Points points[2];  // of B as seen from A, of A as seen from B
    place(b, seen[0], points[0]);
    std::uint32_t of = 0, side = 0;
    double gap = widest_of(a, points[0].x, points[0].y, b.count, side);
    if (!(gap > enough)) {
        place(a, seen[1], points[1]);
        std::uint32_t other_side = 0;
        const double other = widest_of(b, points[1].x, points[1].y, a.count, other_side);
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
