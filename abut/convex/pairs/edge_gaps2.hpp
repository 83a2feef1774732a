#pragma once

// Separating axes of two polygons or two boxes: the gaps in front of all edges. For .cpp files.

#include <abut/convex/pairs/polygon_cores2.hpp>

#include <array>

namespace abut::detail {

/// The edge with the widest gap in front of it, and the corner of the other polygon that is nearest to its line.
struct EdgeGap {
    double gap;        ///< below zero: minus the minimum depth along any edge normal
    std::uint32_t of;  ///< the polygon of the edge. 0: A; 1: B
    std::uint32_t side;
    std::uint32_t corner;  ///< of the other polygon; the first of several
};

/// The widest gap of all edges of A and B, evaluated in SIMD. An edge of A wins a tie to within `tolerance`. `seen[0]`
/// is B relative to A, `seen[1]` A relative to B. If an edge of A has a gap wider than `max_distance`, B's edges aren't
/// tested.
void find_widest_gap(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], double max_distance,
                     double tolerance, EdgeGap& result);
inline void find_widest_gap(const PolygonCore& a, const PolygonCore& b, const LanePose (&seen)[2], double max_distance,
                            double tolerance, EdgeGap& result) {
    const Rigid2 places[2] = {rigid(seen[0]), rigid(seen[1])};
    find_widest_gap(a.sides(), b.sides(), places, max_distance, tolerance, result);
}
/// The edge of a box with the widest gap in front of it, and the other box's corner that is lowest in its direction.
/// The bits of the index, from the lowest: the cosine and the sine of the turn to the other's frame are negative; the
/// other box lies towards the low end of the axis; the axis is x.
inline constexpr auto facing_features = [] {
    struct {
        std::uint8_t side, corner;
    } result[16]{};
    for (std::uint8_t i = 0; i < 16; ++i) {
        const bool along_x = (i & 8) != 0, back = (i & 4) != 0, negative_cos = (i & 1) != 0,
                   negative_sin = (i & 2) != 0;
        // The edge's normal in the frame of the other: a column of the turn, or its opposite.
        const bool left = (along_x ? negative_cos : !negative_sin) != back,
                   down = (along_x ? negative_sin : negative_cos) != back;
        result[i].side = static_cast<std::uint8_t>(along_x ? (back ? 1 : 3) : (back ? 2 : 0));
        result[i].corner = static_cast<std::uint8_t>(left ? (down ? 0 : 3) : (down ? 1 : 2));
    }
    return std::to_array(result);
}();

/// In closed form, without branches, which can't be predicted.
inline void find_widest_gap(const BoxCore& a, const BoxCore& b, const LanePose (&seen)[2], double, double tolerance,
                            EdgeGap& result) {
    using namespace lanes;
    const auto negative = [](Double2 v) { return bits(v < Double2{0, 0}); };
    const Double2 cos = magnitude(seen[0].cos), sin = magnitude(seen[0].sin);
    const Double2 gaps[2] = {
        magnitude(seen[0].position) - a.half() - (cos * b.half() + sin * swapped(b.half())),
        magnitude(seen[1].position) - b.half() - (cos * a.half() + sin * swapped(a.half())),
    };
    const double gap_a = std::max(gaps[0][0], gaps[0][1]), gap_b = std::max(gaps[1][0], gaps[1][1]);
    const std::uint32_t is_x[2] = {gaps[0][0] > gaps[0][1] ? 1u : 0u, gaps[1][0] > gaps[1][1] ? 1u : 0u};
    const std::uint32_t back[2] = {negative(seen[0].position), negative(seen[1].position)};
    // The turn from A's frame to B's, and from B's to A's.
    const std::uint32_t turns[2] = {negative(seen[1].turn()), negative(seen[0].turn())};
    const std::uint32_t of = gap_b > gap_a + tolerance ? 1 : 0;
    const auto& found = facing_features[is_x[of] << 3 | (back[of] >> (1 - is_x[of]) & 1) << 2 | turns[of]];
    result.of = of;
    result.gap = of == 1 ? gap_b : gap_a;
    result.side = found.side;
    result.corner = found.corner;
}

}  // namespace abut::detail
