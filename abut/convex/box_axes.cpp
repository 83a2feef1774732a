#include <abut/convex/box_axes.hpp>
#include <abut/math/lanes-inl.h>

#include <limits>

namespace abut {
namespace {

/// An axis between edges whose squared length is below this is nothing but rounding.
constexpr double no_axis = 1e-12;
/// What a gap along an axis between edges may be off, of all coordinates together, before it is divided by its length.
constexpr double rounding = 1e-14;

/// Gaps of length 1 as their squares, those below zero too.
double signed_square(double gap) {
    return gap * std::abs(gap);
}

}  // namespace

BoxFaceGap widest_face_gap(const BoxFrame& frame) {
    std::array<double, 6> gaps;
    for (std::size_t i = 0; i < 3; ++i) {
        double reach = frame.half_a[i];
        for (std::size_t j = 0; j < 3; ++j) reach += std::abs(frame.axis_b[j][i]) * frame.half_b[j];
        gaps[i] = std::abs(frame.middle[i]) - reach;
    }
    for (std::size_t j = 0; j < 3; ++j) {
        const Triple& axis = frame.axis_b[j];
        const double reach = dot({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])}, frame.half_a);
        gaps[3 + j] = std::abs(dot(axis, frame.middle)) - (frame.half_b[j] + reach);
    }
    return widest_of(gaps);
}

// Two at a time: the edges 0 and 1 of B across each of A's, and then its edge 2 across those of A.
BoxEdgeGaps::BoxEdgeGaps(const BoxFrame& frame, double face_gap) {
    using namespace lanes;
    const Both slack = both(rounding * frame.scale()), face = both(signed_square(face_gap));
    Chosen above_zero{}, above_face{};
    struct Pair {
        Both gap, square;
    };
    // Of edges with these coordinates along the two axes beside an axis of A; `reach_b` is that of B.
    const auto across = [&](Both x, Both y, Both middle_x, Both middle_y, Both half_x, Both half_y, Both reach_b) {
        const Both between = magnitude(middle_y * x - middle_x * y);
        const Both reach_a = half_x * magnitude(y) + half_y * magnitude(x);
        const Pair result{between - (reach_a + reach_b) - slack, x * x + y * y};
        // Without a branch: which one it is can't be guessed.
        const Chosen is_axis = result.square > both(no_axis);
        above_zero |= is_axis & (result.gap > Both{0, 0});
        above_face |= is_axis & (result.gap * magnitude(result.gap) > face * result.square);
        return result;
    };

    const Triple &b0 = frame.axis_b[0], &b1 = frame.axis_b[1], &b2 = frame.axis_b[2];
    const Triple &middle = frame.middle, &half_a = frame.half_a, &half_b = frame.half_b;
    const Both edge[3] = {both(b0[0], b1[0]), both(b0[1], b1[1]), both(b0[2], b1[2])};
    const Both half_next = both(half_b[1], half_b[2]), half_last = both(half_b[2], half_b[0]);
    Both reach_2[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t x = next_axis(i), y = last_axis(i);
        const Both size = magnitude(edge[i]), size_2 = magnitude(both(b2[i]));
        const Both reach = half_next * lower(size_2, size) + half_last * lower(swapped(size), size_2);
        const Pair pair =
            across(edge[x], edge[y], both(middle[x]), both(middle[y]), both(half_a[x]), both(half_a[y]), reach);
        put(pair.gap, &gap[3 * i]);
        put(pair.square, &square[3 * i]);
        // Of edge 2: its next one is 0, its last one 1.
        reach_2[i] = first(half_b[0] * second(size) + half_b[1] * first(size));
    }
    const Pair two =
        across(both(b2[1], b2[2]), both(b2[2], b2[0]), both(middle[1], middle[2]), both(middle[2], middle[0]),
               both(half_a[1], half_a[2]), both(half_a[2], half_a[0]), lower(reach_2[0], reach_2[1]));
    const Pair last = across(both(b2[0]), both(b2[1]), both(middle[0]), both(middle[1]), both(half_a[0]),
                             both(half_a[1]), reach_2[2]);
    gap[2] = two.gap[0];
    gap[5] = two.gap[1];
    gap[8] = last.gap[0];
    square[2] = two.square[0];
    square[5] = two.square[1];
    square[8] = last.square[0];
    apart = bits(above_zero) != 0;
    beats_face = bits(above_face) != 0;
}

bool BoxEdgeGaps::wider_than(double reach) const {
    bool result = false;
    for (std::size_t i = 0; i < 9; ++i)
        result |= gap[i] > 0 && square[i] > no_axis && gap[i] * gap[i] > reach * reach * square[i];
    return result;
}

std::size_t BoxEdgeGaps::widest(double least) const {
    std::size_t best = 9;
    double most = signed_square(least);
    for (std::size_t i = 0; i < 9; ++i) {
        const double here = signed_square(gap[i]);
        if (!(here > most * square[i]) || square[i] <= no_axis) continue;
        most = here / square[i];
        best = i;
    }
    return best;
}

}  // namespace abut
