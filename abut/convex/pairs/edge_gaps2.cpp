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
    side = first_of(found.gaps, sides.capacity(), hn::MaxOfLanes(d, found.widest));
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
    result.corner =
        lowest(points[of], (of == 0 ? b : a).capacity(), reference.normal_x(side), reference.normal_y(side));
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(widest_gap_of_two);

void find_widest_gap(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], double max_distance,
                     double tolerance, EdgeGap& result) {
    HWY_DYNAMIC_DISPATCH(widest_gap_of_two)(a, b, seen, max_distance, tolerance, result);
}

}  // namespace abut::detail
#endif
