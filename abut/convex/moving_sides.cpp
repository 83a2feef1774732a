#include <abut/convex/moving_sides.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/moving_sides.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each kind.
#include <abut/convex/side_lanes-inl.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using namespace rows_of_sides;

/// What is known of the passage, lane by lane, after some of the sides.
struct Passing {
    HWY_ALIGN double enters[2 * most_sides];  ///< of each side of A, then of B; of one that opens, before all times
    Vector coming_x, coming_y, radius, depth;
    Vector last_enters, clear_until, clear_from, deep_from, deep_until;
    std::size_t begin = 0;  ///< of the sides of the one that is looked at

    HWY_INLINE Passing(double balls, double asked)
        : radius(hn::Set(d, balls)),
          depth(hn::Set(d, asked)),
          last_enters(hn::Set(d, -1e300)),
          clear_until(last_enters),
          clear_from(hn::Set(d, 1e300)),
          deep_from(last_enters),
          deep_until(clear_from) {}

    HWY_INLINE void look_at(const Sides& sides, const Points& points, std::uint32_t count, const DVec<2>& coming,
                            std::size_t first) {
        coming_x = hn::Set(d, coming.x);
        coming_y = hn::Set(d, coming.y);
        begin = first;
        tell_gaps(sides, points, count, *this);
    }
    HWY_INLINE void visit(Vector gap_of_cores, Vector normal_x, Vector normal_y, std::size_t i) {
        const Vector gap = hn::Sub(gap_of_cores, radius);
        const Vector closing = hn::Add(hn::Mul(normal_x, coming_x), hn::Mul(normal_y, coming_y));
        const Vector pace = hn::Max(hn::Abs(closing), hn::Set(d, least_closing));
        const Vector per_closing = hn::Div(hn::Set(d, 1), hn::CopySign(pace, closing));
        const auto closes = hn::Gt(per_closing, hn::Zero(d));
        const Vector never = hn::Set(d, 1e300), before_all = hn::Set(d, -1e300);
        const Vector nearer = hn::Mul(hn::Sub(gap, depth), per_closing),
                     farther = hn::Mul(hn::Add(gap, depth), per_closing);
        const Vector at = hn::IfThenElse(closes, hn::Mul(gap, per_closing), before_all);
        hn::Store(at, d, enters + begin + i);
        last_enters = hn::Max(last_enters, at);
        clear_until = hn::Max(clear_until, hn::IfThenElse(closes, nearer, before_all));
        clear_from = hn::Min(clear_from, hn::IfThenElse(closes, never, nearer));
        deep_from = hn::Max(deep_from, hn::IfThenElse(closes, farther, before_all));
        deep_until = hn::Min(deep_until, hn::IfThenElse(closes, never, farther));
    }
};

bool passage_of_any(const Sides& a, const Sides& b, const Rigid2 (&seen)[2], const DVec<2> (&coming)[2], double radius,
                    double depth, double most, Passage& result) {
    Points points[2];  // of B as seen from A, of A as seen from B
    place(b, seen[0], points[0]);
    place(a, seen[1], points[1]);
    Passing passing(radius, depth);
    passing.look_at(a, points[0], b.count, coming[0], 0);
    passing.look_at(b, points[1], a.count, coming[1], a.room);
    result.clear_until = hn::GetLane(hn::MaxOfLanes(d, passing.clear_until));
    result.clear_from = hn::GetLane(hn::MinOfLanes(d, passing.clear_from));
    if (result.misses(most)) return false;
    result.deep_from = hn::GetLane(hn::MaxOfLanes(d, passing.deep_from));
    result.deep_until = hn::GetLane(hn::MinOfLanes(d, passing.deep_until));
    const Vector last = hn::MaxOfLanes(d, passing.last_enters);
    result.enters = hn::GetLane(last);
    const std::uint32_t side = first_of(passing.enters, std::size_t{a.room} + b.room, last);
    const bool of_a = side < a.room;
    result.of = of_a ? 0 : 1;
    result.side = of_a ? side : side - a.room;
    const Sides& reference = of_a ? a : b;
    result.corner = lowest(points[result.of], (of_a ? b : a).room, reference.normal_x[result.side],
                           reference.normal_y[result.side]);
    return true;
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(passage_of_any);

bool passage_of_sides(const Sides& a, const Sides& b, const Rigid2 (&seen)[2], const DVec<2> (&coming)[2],
                      double radius, double depth, double most, Passage& result) {
    return HWY_DYNAMIC_DISPATCH(passage_of_any)(a, b, seen, coming, radius, depth, most, result);
}

}  // namespace abut
#endif
