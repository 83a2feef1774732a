// Corners and sides of two polygons in vectors of lanes: for the .cpp files that Highway compiles once for each kind of
// vector unit. Products and sums are rounded one by one in all of them, and the least of some numbers doesn't depend on
// the order in which they are compared.

#if defined(ABUT_SIDE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_SIDE_LANES_INL_H
#undef ABUT_SIDE_LANES_INL_H
#else
#define ABUT_SIDE_LANES_INL_H
#endif

#include <abut/convex/sides.hpp>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE::rows_of_sides {

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

HWY_INLINE void place(const Sides& sides, const Rigid2& seen, Points& points) {
    const Vector cos = hn::Set(d, seen.cos), sin = hn::Set(d, seen.sin);
    const Vector offset_x = hn::Set(d, seen.x), offset_y = hn::Set(d, seen.y);
    for (std::size_t i = 0; i < sides.room; i += lanes) {
        const Vector x = hn::LoadU(d, sides.x + i), y = hn::LoadU(d, sides.y + i);
        hn::Store(hn::Add(hn::Sub(hn::Mul(cos, x), hn::Mul(sin, y)), offset_x), d, points.x + i);
        hn::Store(hn::Add(hn::Add(hn::Mul(sin, x), hn::Mul(cos, y)), offset_y), d, points.y + i);
    }
}

/// Tells `visitor.visit(gaps, normals' x, normals' y, number of the first)` the gaps in front of `groups` vectors of
/// sides, from `first` on.
template <std::size_t groups, class Visitor>
HWY_INLINE void tell_gaps(const Sides& sides, std::size_t first, const double* x, const double* y, std::uint32_t count,
                          Visitor& visitor) {
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
    for (std::size_t g = 0; g < groups; ++g) {
        const std::size_t i = first + g * lanes;
        visitor.visit(hn::Sub(least[g], hn::LoadU(d, sides.offset + i)), normal_x[g], normal_y[g], i);
    }
}

/// The same of all sides: how far off the nearest of `count` points is.
template <class Visitor>
HWY_INLINE void tell_gaps(const Sides& sides, const Points& points, std::uint32_t count, Visitor& visitor) {
    if (sides.room >= 8)
        tell_gaps<8 / lanes>(sides, 0, points.x, points.y, count, visitor);
    else
        tell_gaps<4 / lanes>(sides, 0, points.x, points.y, count, visitor);
    for (std::size_t first = 8; first < sides.room; first += 4)
        tell_gaps<4 / lanes>(sides, first, points.x, points.y, count, visitor);
}

/// The first of the numbers that equals the largest or least of them, which is in every lane of `value`.
HWY_INLINE std::uint32_t first_of(const double* numbers, std::size_t room, Vector value) {
    for (std::size_t i = 0; i < room; i += lanes) {
        const auto same = hn::Eq(hn::Load(d, numbers + i), value);
        if (!hn::AllFalse(d, same))
            return static_cast<std::uint32_t>(i + static_cast<std::size_t>(hn::FindFirstTrue(d, same)));
    }
    return 0;
}

/// The first of the points that lie lowest along a normal.
HWY_INLINE std::uint32_t lowest(const Points& points, std::size_t room, double normal_x, double normal_y) {
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

}  // namespace abut::HWY_NAMESPACE::rows_of_sides
HWY_AFTER_NAMESPACE();

#endif
