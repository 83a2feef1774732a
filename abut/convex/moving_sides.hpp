#pragma once

// When the sides of two polygons part them while one moves straight: separating axes in motion. For .cpp files.
//
// The gap in front of a side changes evenly along a straight motion: g(t) = g - c t, where c is by how much the side
// closes. The two are apart while any gap is above zero, and as deep in as the least of the depths behind all sides. So
// the time in which they are deeper than some depth begins where the last closing side is so deep, and ends where the
// first opening one is so no more: a line cut off by the sides of the Minkowski difference (Cyrus, Beck, "Generalized
// two- and three-dimensional clipping", 1978), which are those of both.

#include <abut/convex/sides.hpp>
#include <abut/math/lanes-inl.h>

namespace abut {

/// Times are parts of the motion, and may lie before and after it.
struct Passage {
    double clear_until, clear_from;  ///< before the one and after the other they are farther apart than asked for
    double deep_from, deep_until;    ///< between them they are deeper in than asked for
    double enters;                   ///< the last of the closing sides comes to touch
    std::uint32_t of;                ///< 0: a side of A; 1: of B
    std::uint32_t side;
    std::uint32_t corner;  ///< of the other, the nearest to its line; where several are as near, the first

    /// They come nowhere nearer than asked for, up to a time.
    bool misses(double most) const { return clear_until > (clear_from < most ? clear_from : most) || clear_from < 0; }
    bool gets_deep() const { return deep_from < deep_until; }
};

/// What closes by less is parallel: no quotient of what floats can tell has no end then.
inline constexpr double least_closing = 1e-150;

/// `seen[0]` is B as seen from A, `seen[1]` A as seen from B; `coming[0]` how A moves, as B would have it, in A's
/// frame, `coming[1]` how B does as A would have it, in B's. `depth`: how far apart, or deep in, is asked for;
/// `radius`: of balls around. False, and what is told of a side is of no use, where they miss one another up to `most`.
bool passage_of_sides(const Sides& a, const Sides& b, const Rigid2 (&seen)[2], const DVec<2> (&coming)[2],
                      double radius, double depth, double most, Passage& result);

/// What the two axes of a box see of another box that comes by, one in each lane.
struct BoxPassage {
    lanes::Both clear_until, clear_from, deep_from, deep_until, enters;
    std::uint32_t ahead;  ///< bits: the side that closes is that at the high end

    /// `half` and `other` are their half extents, `turn` the cosine and sine between them, of any sign; `place` is the
    /// other's middle as this one sees it, `coming` how this one moves.
    BoxPassage(lanes::Both half, lanes::Both other, lanes::Both turn, lanes::Both place, lanes::Both coming,
               double radius, double depth) {
        using namespace lanes;
        const Both size = magnitude(turn);
        const Both reach = half + (first(size) * other + second(size) * swapped(other)) + both(radius);
        const Both closes = greater(magnitude(coming), both(least_closing)), per_closing = Both{1, 1} / closes;
        // Mirrored, so that it moves to the high end.
        constexpr long long sign = static_cast<long long>(1ull << 63);
        const Chosen turned = reinterpret_cast<Chosen>(coming) & Chosen{sign, sign};
        const Both middle = reinterpret_cast<Both>(reinterpret_cast<Chosen>(place) ^ turned);
        const Both near = middle - reach, far = middle + reach, slack = both(depth);
        ahead = signs(coming) ^ 3;
        enters = near * per_closing;
        clear_until = (near - slack) * per_closing;
        clear_from = (far + slack) * per_closing;
        deep_from = (near + slack) * per_closing;
        deep_until = (far - slack) * per_closing;
    }
};

/// The same of two boxes, all in one place. `half`: of A and B; `turn`: B's as A sees it; `place`: the other's middle,
/// as A and as B see it.
inline bool passage_of_boxes(const lanes::Both (&half)[2], lanes::Both turn, const lanes::Both (&place)[2],
                             const lanes::Both (&coming)[2], double radius, double depth, double most,
                             Passage& result) {
    using namespace lanes;
    const BoxPassage a(half[0], half[1], turn, place[0], coming[0], radius, depth);
    const BoxPassage b(half[1], half[0], turn, place[1], coming[1], radius, depth);
    const auto last = [](Both v, Both w) {
        const Both both_axes = greater(v, w);
        return greater(both_axes, swapped(both_axes));
    };
    const auto soonest = [](Both v, Both w) {
        const Both both_axes = lesser(v, w);
        return lesser(both_axes, swapped(both_axes));
    };
    result.clear_until = last(a.clear_until, b.clear_until)[0];
    result.clear_from = soonest(a.clear_from, b.clear_from)[0];
    if (result.misses(most)) return false;
    result.deep_from = last(a.deep_from, b.deep_from)[0];
    result.deep_until = soonest(a.deep_until, b.deep_until)[0];
    const Both enters = last(a.enters, b.enters);
    result.enters = enters[0];
    // One of them is the last; where none is, as of what is not a number, nothing is deep.
    const std::uint32_t is_last = bits(a.enters == enters) | bits(b.enters == enters) << 2 | 8u;
    const std::uint32_t axis = lowest_bit(is_last), ahead = a.ahead | b.ahead << 2;
    // As `Outline::set_box` counts them: up, left, down, right.
    static constexpr std::uint32_t sides[4] = {1, 3, 2, 0};
    result.of = axis >> 1;
    result.side = sides[(axis & 1) << 1 | (ahead >> axis & 1)];
    // The lowest corner is that of the quadrant which the side's normal comes from, seen from the other.
    static constexpr double normals[4][2] = {{0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const double* normal = normals[result.side];
    const double cos = turn[0], sin = result.of == 0 ? -turn[1] : turn[1];
    const double up_x = cos * normal[0] - sin * normal[1], up_y = sin * normal[0] + cos * normal[1];
    static constexpr std::uint32_t corners[4] = {0, 3, 1, 2};
    result.corner = corners[(up_x > 0 ? 2u : 0u) | (up_y > 0 ? 1u : 0u)];
    return true;
}

}  // namespace abut
