#pragma once

// The closed forms of balls, capsules and boxes that are short enough to be inline. For .cpp files.

#include <abut/convex/pairs/round3.hpp>

namespace abut::detail {

inline bool distance_of(const PlacedBall& a, const PlacedBall& b, CoresDistance& found) {
    using namespace lanes;
    const Double3 between = b.center - a.center;
    const Double2 gap = root(dot(between, between));
    found.distance = gap;
    found.normal = gap[0] > 0 ? between * (1 / gap) : Double3{double2(1, 0), double2(0)};
    found.on_a = a.center;
    found.on_b = b.center;
    found.part_a = found.part_b = {};
    add_balls(a.radius, b.radius, found);
    return true;
}

/// The closest point on a box, in the frame of the box.
struct BoxClosestPoint {
    lanes::Double3 offset;      ///< to the point; inside, of length 1 along the nearest outward normal
    lanes::Double2 distance;    ///< of the point; below zero inside
    lanes::Double2 per_length;  ///< normalises the offset
    CoreFeature part;
};

/// For a point outside. Returns false if it isn't outside, or not finite.
[[gnu::always_inline]] inline bool nearest_from_outside(const lanes::Double3& half, const lanes::Double3& point,
                                                        BoxClosestPoint& place) {
    using namespace lanes;
    const Double3 inside{lesser(greater(point.xy, -half.xy), half.xy), lesser(greater(point.z, -half.z), half.z)};
    place.offset = point - inside;
    const Double2 square = dot(place.offset, place.offset), none{0, 0};
    place.distance = root(square);
    // The division runs in parallel with the root.
    place.per_length = place.distance * (1 / square);
    place.part.free = bits(place.offset.xy == none) | (bits(place.offset.z == none) & 1u) << 2;
    place.part.low = (signs(place.offset.xy) | (signs(place.offset.z) & 1u) << 2) & ~place.part.free;
    return square[0] > std::numeric_limits<double>::min() && square[0] <= std::numeric_limits<double>::max();
}

/// For a point inside.
inline void nearest_from_inside(const DVec<3>& half, const DVec<3>& point, BoxClosestPoint& place) {
    int nearest = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(point[i]) - half[i] > std::abs(point[nearest]) - half[nearest]) nearest = i;
    const double sign = point[nearest] < 0 ? -1 : 1;
    place.offset = lanes::double3(axis<3>(nearest, sign));
    place.distance = lanes::double2(std::abs(point[nearest]) - half[nearest]);
    place.per_length = lanes::double2(1);
    place.part = {sign < 0 ? 1u << nearest : 0, 7u ^ 1u << nearest};
}

[[gnu::always_inline]] inline void set_ball_and_box(const PlacedBox& box, const PlacedBall& ball,
                                                    const BoxClosestPoint& place, bool outside, CoresDistance& found) {
    using namespace lanes;
    const Double3 offset = box.axes.vector(place.offset);
    found.distance = place.distance;
    found.normal = offset * place.per_length;
    found.on_a = ball.center - (outside ? offset : offset * place.distance);
    found.on_b = ball.center;
    found.part_a = place.part;
    found.part_b = {};
    add_balls(box.radius, ball.radius, found);
}

// Closed forms without branches, for most pairs of their kinds. False: `distance_of` goes on.

template <class A, class B>
bool short_distance(const A&, const B&, CoresDistance&) {
    return false;
}
inline bool short_distance(const PlacedBall& a, const PlacedBall& b, CoresDistance& found) {
    return distance_of(a, b, found);
}
[[gnu::always_inline]] inline bool short_distance(const PlacedBox& box, const PlacedBall& ball, CoresDistance& found) {
    BoxClosestPoint place;
    if (!nearest_from_outside(box.half, box.axes.transposed(ball.center - box.center), place)) return false;
    set_ball_and_box(box, ball, place, true, found);
    return true;
}
[[gnu::always_inline]] inline bool short_distance(const PlacedBall& ball, const PlacedBox& box, CoresDistance& found) {
    if (!short_distance(box, ball, found)) return false;
    flip(found);
    return true;
}

inline bool distance_of(const PlacedBox& box, const PlacedBall& ball, CoresDistance& found) {
    if (short_distance(box, ball, found)) return true;
    BoxClosestPoint place;
    nearest_from_inside(lanes::vector(box.half), lanes::vector(box.axes.transposed(ball.center - box.center)), place);
    set_ball_and_box(box, ball, place, false, found);
    return lanes::finite(box.half.xy + box.half.z);
}

/// The closest points: the ends of the common perpendicular, or an end and its projection. Returns false, with `found`
/// undefined, if the segments nearly cross, are nearly parallel, very large or small, or not finite. Ericson, Real-Time
/// Collision Detection (2005), 5.1.9.
[[gnu::always_inline]] inline bool short_distance(const PlacedSegment& a, const PlacedSegment& b,
                                                  CoresDistance& found) {
    using namespace lanes;
    // Squares of the sine of their angle, and of the gap relative to their lengths. Within these limits rounding moves
    // the closest points along the segments by at most 1e-9 of their distance.
    constexpr double parallel = 1e-6, near = 1e-10, max_square = 1e200;

    const Double3 along_a = a.to - a.from, along_b = b.to - b.from, between_ends = b.from - a.from;
    const Double2 square_a = dot(along_a, along_a), square_b = dot(along_b, along_b), crossed = dot(along_a, along_b);
    const Double2 rise_a = dot(along_a, between_ends), rise_b = dot(along_b, between_ends);
    const Double2 squares = square_a * square_b, whole = squares - crossed * crossed;

    // All steps run without branches, which can't be predicted; a step that isn't needed changes nothing. Parameters
    // stay multiplied by their denominators, so that the next step doesn't wait for a division. A point at an end gets
    // the exact parameter, whatever the quotient rounds to.
    const Double2 end{1, 1};
    const Double2 whole_a = whole * squares, one_a = 1 / whole_a, whole_b = whole * square_b;
    const Double2 far_a = limited(square_b * rise_a - crossed * rise_b, whole);
    const Double2 far_b = limited(crossed * far_a - rise_b * whole, whole_b);
    const Double2 part_b = lesser(greater(far_b * (square_a * one_a), select(far_b >= whole_b, end)), end);
    const Double2 part_a = limited((crossed * far_b + rise_a * whole_b) * one_a, end), parts = lower(part_a, part_b);
    if (!(whole[0] > parallel * squares[0] && whole_a[0] + one_a[0] < max_square)) return false;

    const Double3 on_a = along_a * part_a, between = along_b * part_b + between_ends - on_a;
    // The root and the quotient run in parallel.
    const Double2 apart = dot(between, between), gap = root(apart);
    if (!(apart[0] > near * (square_a[0] + square_b[0]))) return false;
    found.normal = between * (gap * (1 / apart));
    found.distance = gap - (a.radius + b.radius);
    found.on_a = a.from + on_a + found.normal * a.radius;
    found.on_b = found.on_a + found.normal * found.distance;
    set_segment_features(parts, found);
    return true;
}

inline bool distance_of(const PlacedSegment& a, const PlacedSegment& b, CoresDistance& found) {
    return short_distance(a, b, found) || distance_of_any_segments(a, b, found);
}

/// Pairs in the other order.
template <class A, class B>
bool distance_of(const A& a, const B& b, CoresDistance& found) {
    if (short_distance(a, b, found)) return true;
    if (!distance_of(b, a, found)) return false;
    flip(found);
    return true;
}

}  // namespace abut::detail
