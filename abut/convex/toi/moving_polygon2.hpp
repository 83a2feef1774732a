#pragma once

// The time of impact of two polygons in linear motion, by separating axes. For .cpp files.
//
// The gap in front of an edge is linear in time along a straight motion: g(t) = g - c t, with the closing speed c. The
// polygons are disjoint while any gap is above zero; their depth is the minimum of the depths behind all edges. The
// interval in which they are deeper than some depth begins when the last closing edge is that deep, and ends when the
// first opening edge no longer is. It is a line clipped by the edges of the Minkowski difference, which are the edges
// of both (Cyrus, Beck, "Generalized two- and three-dimensional clipping", 1978).

#include <abut/convex/polygon_soa.hpp>
#include <abut/math/simd/double2-inl.h>

namespace abut::detail {

/// Times are fractions of the motion, and may lie before or after it.
struct Passage {
    double clear_until, clear_from;  ///< before the first and after the second the distance is above the limit
    double deep_from, deep_until;    ///< between them the depth is above the limit
    double enters;                   ///< the time of impact: the last closing edge touches
    std::uint32_t of;                ///< the polygon of the edge. 0: A, 1: B
    std::uint32_t side;
    std::uint32_t corner;  ///< of the other polygon, nearest to the edge's line; the first of several

    /// Whether the distance stays above the limit until `latest`.
    bool misses(double latest) const {
        return clear_until > (clear_from < latest ? clear_from : latest) || clear_from < 0;
    }
    bool penetrates() const { return deep_from < deep_until; }
};

/// An edge that closes more slowly counts as parallel: quotients of coordinates in float range stay finite.
inline constexpr double min_closing_speed = 1e-150;

/// `placed[0]` is B relative to A, `placed[1]` A relative to B. `motion[0]` is the motion of A relative to B in A's
/// frame, `motion[1]` that of B relative to A in B's. `depth` is the limit of distance and depth, `radius` the sum of
/// the radii. Returns false if they miss each other until `latest`; then the edge and corner are unset.
bool passage_of_polygons(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&placed)[2],
                         const DVec<2> (&motion)[2], double radius, double depth, double latest, Passage& result);

/// The passage of another box across the two axes of a box, one per lane.
struct BoxPassage {
    lanes::Double2 clear_until, clear_from, deep_from, deep_until, enters;
    std::uint32_t ahead;  ///< bits: the closing edge is at the high end of the axis

    /// `half` and `other` are the half extents, `turn` the cosine and sine between the boxes, of any sign; `place` is
    /// the other's middle relative to this one, `motion` the motion of this one.
    BoxPassage(lanes::Double2 half, lanes::Double2 other, lanes::Double2 turn, lanes::Double2 place,
               lanes::Double2 motion, double radius, double depth) {
        using namespace lanes;
        const Double2 size = magnitude(turn);
        const Double2 reach = half + (first(size) * other + second(size) * swapped(other)) + double2(radius);
        const Double2 closes = greater(magnitude(motion), double2(min_closing_speed)),
                      inverse_speed = Double2{1, 1} / closes;
        // Mirrored, so that it moves towards the high end.
        const Double2 middle = flipped_by(place, motion);
        const Double2 near = middle - reach, far = middle + reach, tolerance = double2(depth);
        ahead = signs(motion) ^ 3;
        enters = near * inverse_speed;
        clear_until = (near - tolerance) * inverse_speed;
        clear_from = (far + tolerance) * inverse_speed;
        deep_from = (near + tolerance) * inverse_speed;
        deep_until = (far - tolerance) * inverse_speed;
    }
};

/// The passage of two boxes. `half`: of A and B; `turn`: B's relative to A; `place`: the other's middle, relative to A
/// and to B.
inline bool passage_of_boxes(const lanes::Double2 (&half)[2], lanes::Double2 turn, const lanes::Double2 (&place)[2],
                             const lanes::Double2 (&motion)[2], double radius, double depth, double latest,
                             Passage& result) {
    using namespace lanes;
    const BoxPassage a(half[0], half[1], turn, place[0], motion[0], radius, depth);
    const BoxPassage b(half[1], half[0], turn, place[1], motion[1], radius, depth);
    const auto last = [](Double2 v, Double2 w) {
        const Double2 both_axes = greater(v, w);
        return greater(both_axes, swapped(both_axes));
    };
    const auto soonest = [](Double2 v, Double2 w) {
        const Double2 both_axes = lesser(v, w);
        return lesser(both_axes, swapped(both_axes));
    };
    result.clear_until = last(a.clear_until, b.clear_until)[0];
    result.clear_from = soonest(a.clear_from, b.clear_from)[0];
    if (result.misses(latest)) return false;
    result.deep_from = last(a.deep_from, b.deep_from)[0];
    result.deep_until = soonest(a.deep_until, b.deep_until)[0];
    const Double2 enters = last(a.enters, b.enters);
    result.enters = enters[0];
    // One of them is the last. With NaN none is, and nothing is deep.
    const std::uint32_t is_last = bits(a.enters == enters) | bits(b.enters == enters) << 2 | 8u;
    const std::uint32_t axis = lowest_bit(is_last), ahead = a.ahead | b.ahead << 2;
    // In the edge order of `PlacedPolygon::set_box`: up, left, down, right.
    static constexpr std::uint32_t sides[4] = {1, 3, 2, 0};
    result.of = axis >> 1;
    result.side = sides[(axis & 1) << 1 | (ahead >> axis & 1)];
    // The lowest corner belongs to the quadrant opposite to the edge's normal, in the other's frame.
    static constexpr double normals[4][2] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const double* normal = normals[result.side];
    const double cos = turn[0], sin = result.of == 0 ? -turn[1] : turn[1];
    const double up_x = cos * normal[0] - sin * normal[1], up_y = sin * normal[0] + cos * normal[1];
    static constexpr std::uint32_t corners[4] = {0, 3, 1, 2};
    result.corner = corners[(up_x > 0 ? 2u : 0u) | (up_y > 0 ? 1u : 0u)];
    return true;
}

}  // namespace abut::detail
