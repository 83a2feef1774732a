// Two polygons in SIMD lanes, for the .cpp files that Highway compiles once for each target. Products and sums are
// rounded one by one on all targets, and a minimum doesn't depend on the order of the comparisons.

#if defined(ABUT_SIDE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_SIDE_LANES_INL_H
#undef ABUT_SIDE_LANES_INL_H
#else
#define ABUT_SIDE_LANES_INL_H
#endif

#include <abut/convex/polygon_soa.hpp>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE::polygon_simd {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, soa_lanes>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes d;
constexpr std::size_t lanes = hn::MaxLanes(d);

/// Rows as long as those of PolygonSoa.
struct Points {
    HWY_ALIGN double x[max_soa_edges];
    HWY_ALIGN double y[max_soa_edges];
};

HWY_INLINE void place(const PolygonSoa& sides, const Rigid2& pose, Points& points) {
    const Vector cos = hn::Set(d, pose.cos), sin = hn::Set(d, pose.sin);
    const Vector offset_x = hn::Set(d, pose.x), offset_y = hn::Set(d, pose.y);
    for (std::size_t i = 0; i < sides.capacity(); i += lanes) {
        const Vector x = hn::LoadU(d, sides.at(i)), y = hn::LoadU(d, sides.at(i) + soa_lanes);
        hn::Store(hn::Add(hn::Sub(hn::Mul(cos, x), hn::Mul(sin, y)), offset_x), d, points.x + i);
        hn::Store(hn::Add(hn::Add(hn::Mul(sin, x), hn::Mul(cos, y)), offset_y), d, points.y + i);
    }
}

/// Calls `visitor.visit(gaps, normals' x, normals' y, index of the first)` with the gaps in front of `groups` vectors
/// of edges, from `first` on.
template <std::size_t groups, class Visitor>
HWY_INLINE void visit_edge_gaps(const PolygonSoa& sides, std::size_t first, const double* x, const double* y,
                                std::uint32_t count, Visitor& visitor) {
    Vector normal_x[groups], normal_y[groups], lowest_height[groups];
    const Vector x0 = hn::Set(d, x[0]), y0 = hn::Set(d, y[0]);
    for (std::size_t g = 0; g < groups; ++g) {
        const double* const numbers = sides.at(first + g * lanes);
        normal_x[g] = hn::LoadU(d, numbers + 2 * soa_lanes);
        normal_y[g] = hn::LoadU(d, numbers + 3 * soa_lanes);
        lowest_height[g] = hn::Add(hn::Mul(normal_x[g], x0), hn::Mul(normal_y[g], y0));
    }
    for (std::uint32_t k = 1; k < count; ++k) {
        const Vector xk = hn::Set(d, x[k]), yk = hn::Set(d, y[k]);
        for (std::size_t g = 0; g < groups; ++g)
            lowest_height[g] = hn::Min(lowest_height[g], hn::Add(hn::Mul(normal_x[g], xk), hn::Mul(normal_y[g], yk)));
    }
    for (std::size_t g = 0; g < groups; ++g) {
        const std::size_t i = first + g * lanes;
        visitor.visit(hn::Sub(lowest_height[g], hn::LoadU(d, sides.at(i) + 4 * soa_lanes)), normal_x[g], normal_y[g],
                      i);
    }
}

/// Visits all edges: the gap in front of each is its distance from the nearest of `count` points.
template <class Visitor>
HWY_INLINE void visit_edge_gaps(const PolygonSoa& sides, const Points& points, std::uint32_t count, Visitor& visitor) {
    if (sides.capacity() >= 8)
        visit_edge_gaps<8 / lanes>(sides, 0, points.x, points.y, count, visitor);
    else
        visit_edge_gaps<4 / lanes>(sides, 0, points.x, points.y, count, visitor);
    for (std::size_t first = 8; first < sides.capacity(); first += 4)
        visit_edge_gaps<4 / lanes>(sides, first, points.x, points.y, count, visitor);
}

/// The first index whose number equals `value`, the maximum or minimum of all, which is in every lane.
HWY_INLINE std::uint32_t first_of(const double* numbers, std::size_t capacity, Vector value) {
    for (std::size_t i = 0; i < capacity; i += lanes) {
        const auto same = hn::Eq(hn::Load(d, numbers + i), value);
        if (!hn::AllFalse(d, same))
            return static_cast<std::uint32_t>(i + static_cast<std::size_t>(hn::FindFirstTrue(d, same)));
    }
    return 0;
}

/// The first of the lowest points along a normal.
HWY_INLINE std::uint32_t lowest(const Points& points, std::size_t capacity, double normal_x, double normal_y) {
    HWY_ALIGN double heights[max_soa_edges];
    const Vector x = hn::Set(d, normal_x), y = hn::Set(d, normal_y);
    Vector lowest_height = hn::Set(d, 1e300);
    for (std::size_t i = 0; i < capacity; i += lanes) {
        const Vector height = hn::Add(hn::Mul(x, hn::Load(d, points.x + i)), hn::Mul(y, hn::Load(d, points.y + i)));
        hn::Store(height, d, heights + i);
        lowest_height = hn::Min(lowest_height, height);
    }
    return first_of(heights, capacity, hn::MinOfLanes(d, lowest_height));
}

}  // namespace abut::detail::HWY_NAMESPACE::polygon_simd
HWY_AFTER_NAMESPACE();

#endif
