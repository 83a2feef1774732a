#include <abut/convex/toi/moving_polygon2.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/toi/moving_polygon2.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <abut/convex/polygon_simd-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

using namespace polygon_simd;

/// The passage in each lane, after some of the edges.
struct PassageBuilder {
    HWY_ALIGN double enters[2 * max_soa_edges];  ///< of each side of A, then of B; of one that opens, before all times
    Vector motion_x, motion_y, radius, depth;
    Vector last_enters, clear_until, clear_from, deep_from, deep_until;
    std::size_t begin = 0;  ///< the first edge of the current polygon in `enters`

    HWY_INLINE PassageBuilder(double balls, double limit)
        : radius(hn::Set(d, balls)),
          depth(hn::Set(d, limit)),
          last_enters(hn::Set(d, -1e300)),
          clear_until(last_enters),
          clear_from(hn::Set(d, 1e300)),
          deep_from(last_enters),
          deep_until(clear_from) {}

    HWY_INLINE void add(const PolygonSoa& sides, const Points& points, std::uint32_t count, const DVec<2>& motion,
                        std::size_t first) {
        motion_x = hn::Set(d, motion.x);
        motion_y = hn::Set(d, motion.y);
        begin = first;
        visit_edge_gaps(sides, points, count, *this);
    }
    HWY_INLINE void visit(Vector gap_of_cores, Vector normal_x, Vector normal_y, std::size_t i) {
        const Vector gap = hn::Sub(gap_of_cores, radius);
        const Vector closing = hn::Add(hn::Mul(normal_x, motion_x), hn::Mul(normal_y, motion_y));
        const Vector speed = hn::Max(hn::Abs(closing), hn::Set(d, min_closing_speed));
        const Vector inverse_speed = hn::Div(hn::Set(d, 1), hn::CopySign(speed, closing));
        const auto closes = hn::Gt(inverse_speed, hn::Zero(d));
        const Vector never = hn::Set(d, 1e300), always = hn::Set(d, -1e300);
        const Vector nearer = hn::Mul(hn::Sub(gap, depth), inverse_speed),
                     farther = hn::Mul(hn::Add(gap, depth), inverse_speed);
        const Vector at = hn::IfThenElse(closes, hn::Mul(gap, inverse_speed), always);
        hn::Store(at, d, enters + begin + i);
        last_enters = hn::Max(last_enters, at);
        clear_until = hn::Max(clear_until, hn::IfThenElse(closes, nearer, always));
        clear_from = hn::Min(clear_from, hn::IfThenElse(closes, never, nearer));
        deep_from = hn::Max(deep_from, hn::IfThenElse(closes, farther, always));
        deep_until = hn::Min(deep_until, hn::IfThenElse(closes, never, farther));
    }
};

bool passage_of_any(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&placed)[2], const DVec<2> (&motion)[2],
                    double radius, double depth, double latest, Passage& result) {
    Points points[2];  // of B relative to A, of A relative to B
    place(b, placed[0], points[0]);
    place(a, placed[1], points[1]);
    PassageBuilder builder(radius, depth);
    // A point has no edges.
    const std::uint32_t edges_of_a = a.count > 1 ? a.capacity() : 0, edges_of_b = b.count > 1 ? b.capacity() : 0;
    if (edges_of_a > 0) builder.add(a, points[0], b.count, motion[0], 0);
    if (edges_of_b > 0) builder.add(b, points[1], a.count, motion[1], edges_of_a);
    result.clear_until = hn::GetLane(hn::MaxOfLanes(d, builder.clear_until));
    result.clear_from = hn::GetLane(hn::MinOfLanes(d, builder.clear_from));
    if (result.misses(latest)) return false;
    result.deep_from = hn::GetLane(hn::MaxOfLanes(d, builder.deep_from));
    result.deep_until = hn::GetLane(hn::MinOfLanes(d, builder.deep_until));
    const Vector last = hn::MaxOfLanes(d, builder.last_enters);
    result.enters = hn::GetLane(last);
    const std::uint32_t side = first_of(builder.enters, std::size_t{edges_of_a} + edges_of_b, last);
    const bool of_a = side < edges_of_a;
    result.of = of_a ? 0 : 1;
    result.side = of_a ? side : side - edges_of_a;
    const PolygonSoa& reference = of_a ? a : b;
    result.corner = lowest(points[result.of], (of_a ? b : a).capacity(), reference.normal_x(result.side),
                           reference.normal_y(result.side));
    return true;
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(passage_of_any);

bool passage_of_polygons(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&placed)[2],
                         const DVec<2> (&motion)[2], double radius, double depth, double latest, Passage& result) {
    return HWY_DYNAMIC_DISPATCH(passage_of_any)(a, b, placed, motion, radius, depth, latest, result);
}

}  // namespace abut::detail
#endif
