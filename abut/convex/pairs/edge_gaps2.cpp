// Highway compiles this file once for each SIMD target and selects the best at run time. Products and sums are rounded
// one by one in all of them, and a minimum doesn't depend on the order of the comparisons.

#include <abut/convex/pairs/edge_gaps2.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/pairs/edge_gaps2.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <abut/convex/polygon_simd-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

using namespace polygon_simd;

/// All gaps, and the widest of each lane.
struct Widest {
    HWY_ALIGN double gaps[max_soa_edges];
    Vector widest;

    HWY_INLINE Widest() : widest(hn::Set(d, -1e300)) {}
    HWY_INLINE void visit(Vector gap, Vector, Vector, std::size_t i) {
        hn::Store(gap, d, gaps + i);
        widest = hn::Max(widest, gap);
    }
};

/// The widest gap, and its first edge. It returns no structure: reading one as a whole right after its parts were
/// written stalls.
double widest_of(const PolygonSoa& sides, const Points& points, std::uint32_t count, std::uint32_t& side) {
    Widest found;
    visit_edge_gaps(sides, points, count, found);
    side = first_of(found.gaps, sides.capacity, hn::MaxOfLanes(d, found.widest));
    return found.gaps[side];
}

void widest_gap_of_two(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], double max_distance,
                       double tolerance, EdgeGap& result) {
    Points points[2];  // of B relative to A, of A relative to B
    place(b, seen[0], points[0]);
    std::uint32_t of = 0, side = 0;
    double gap = widest_of(a, points[0], b.count, side);
    if (!(gap > max_distance)) {
        place(a, seen[1], points[1]);
        std::uint32_t other_side = 0;
        const double other = widest_of(b, points[1], a.count, other_side);
        of = other > gap + tolerance ? 1 : 0;
        gap = of == 1 ? other : gap;
        side = of == 1 ? other_side : side;
    }
    const PolygonSoa& reference = of == 0 ? a : b;
    result.gap = gap;
    result.of = of;
    result.side = side;
    result.corner = lowest(points[of], (of == 0 ? b : a).capacity, reference.normal_x[side], reference.normal_y[side]);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(widest_gap_of_two);

namespace {

/// The edge of a box that faces a point, and the gap in front of it, for a shape of this extent along the axes. Without
/// branches, which can't be predicted.
double gap_to_box(const DVec<2>& half, const DVec<2>& place, double reach_x, double reach_y, std::uint32_t& side) {
    const double gap_x = std::abs(place.x) - half.x - reach_x;
    const double gap_y = std::abs(place.y) - half.y - reach_y;
    const std::uint32_t along_x = gap_x > gap_y ? 1 : 0;
    const std::uint32_t back_x = place.x < 0 ? 1 : 0, back_y = place.y < 0 ? 1 : 0;
    static constexpr std::uint32_t sides[8] = {0, 2, 0, 2, 3, 3, 1, 1};
    side = sides[along_x << 2 | back_x << 1 | back_y];
    return std::max(gap_x, gap_y);
}

}  // namespace

void gap_of_boxes(const DVec<2>& a, const DVec<2>& b, const Rigid2 (&seen)[2], double tolerance, EdgeGap& result) {
    const double cos = std::abs(seen[0].cos), sin = std::abs(seen[0].sin);
    std::uint32_t sides[2];
    const double gap = gap_to_box(a, {seen[0].x, seen[0].y}, cos * b.x + sin * b.y, sin * b.x + cos * b.y, sides[0]);
    const double other = gap_to_box(b, {seen[1].x, seen[1].y}, cos * a.x + sin * a.y, sin * a.x + cos * a.y, sides[1]);
    const std::uint32_t of = other > gap + tolerance ? 1 : 0;
    result.gap = of == 1 ? other : gap;
    result.of = of;
    result.side = sides[of];
    // The other's lowest corner belongs to the quadrant opposite to the normal.
    static constexpr double normals[4][2] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const DVec<2> up = seen[1 - of].vector({normals[sides[of]][0], normals[sides[of]][1]});
    static constexpr std::uint32_t corners[4] = {0, 3, 1, 2};
    result.corner = corners[(up.x > 0 ? 2u : 0u) | (up.y > 0 ? 1u : 0u)];
}

void widest_edge_gap(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], double max_distance,
                     double tolerance, EdgeGap& result) {
    if (a.order == CornerOrder::box && b.order == CornerOrder::box)
        return gap_of_boxes({a.offset[1], a.offset[0]}, {b.offset[1], b.offset[0]}, seen, tolerance, result);
    HWY_DYNAMIC_DISPATCH(widest_gap_of_two)(a, b, seen, max_distance, tolerance, result);
}

}  // namespace abut::detail
#endif
