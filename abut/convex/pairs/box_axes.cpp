#include <abut/convex/pairs/box_axes.hpp>
#include <abut/math/simd/double2-inl.h>

namespace abut::detail {
namespace {

/// The rounding error of a gap along an edge axis, relative to the sum of all coordinates, before it is normalised.
constexpr double relative_rounding = 1e-14;

/// The square of a gap with its sign.
double signed_square(double gap) {
    return gap * std::abs(gap);
}

}  // namespace

// Two axes at a time: edges 0 and 1 of B with each edge of A, then edge 2 of B with those of A.
BoxEdgeGaps::BoxEdgeGaps(const BoxFrame& frame, double face_gap) {
    using namespace lanes;
    const Double2 rounding_error = double2(relative_rounding * frame.scale()), face = double2(signed_square(face_gap));
    Mask2 above_zero{}, above_face{};
    struct Pair {
        Double2 gap, square;
    };
    // For edges with these coordinates along the two axes beside an axis of A; `reach_b` is that of B.
    const auto across = [&](Double2 x, Double2 y, Double2 middle_x, Double2 middle_y, Double2 half_x, Double2 half_y,
                            Double2 reach_b) {
        const Double2 between = magnitude(middle_y * x - middle_x * y);
        const Double2 reach_a = half_x * magnitude(y) + half_y * magnitude(x);
        const Pair result{between - (reach_a + reach_b) - rounding_error, x * x + y * y};
        // Without a branch, because it can't be predicted.
        const Mask2 is_axis = result.square > double2(min_axis_square);
        above_zero |= is_axis & (result.gap > Double2{0, 0});
        above_face |= is_axis & (result.gap * magnitude(result.gap) > face * result.square);
        return result;
    };

    const Triple &b0 = frame.axis_b[0], &b1 = frame.axis_b[1], &b2 = frame.axis_b[2];
    const Triple &middle = frame.middle, &half_a = frame.half_a, &half_b = frame.half_b;
    const Double2 edge[3] = {double2(b0[0], b1[0]), double2(b0[1], b1[1]), double2(b0[2], b1[2])};
    const Double2 half_next = double2(half_b[1], half_b[2]), half_last = double2(half_b[2], half_b[0]);
    Double2 reach_2[3];
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t x = next_axis(i), y = last_axis(i);
        const Double2 size = magnitude(edge[i]), size_2 = magnitude(double2(b2[i]));
        const Double2 reach = half_next * lower(size_2, size) + half_last * lower(swapped(size), size_2);
        const Pair pair = across(edge[x], edge[y], double2(middle[x]), double2(middle[y]), double2(half_a[x]),
                                 double2(half_a[y]), reach);
        put(pair.gap, &gap[3 * i]);
        put(pair.square, &square[3 * i]);
        // For edge 2, whose next edge is 0 and whose last is 1.
        reach_2[i] = first(half_b[0] * second(size) + half_b[1] * first(size));
    }
    const Pair two = across(double2(b2[1], b2[2]), double2(b2[2], b2[0]), double2(middle[1], middle[2]),
                            double2(middle[2], middle[0]), double2(half_a[1], half_a[2]), double2(half_a[2], half_a[0]),
                            lower(reach_2[0], reach_2[1]));
    const Pair last = across(double2(b2[0]), double2(b2[1]), double2(middle[0]), double2(middle[1]), double2(half_a[0]),
                             double2(half_a[1]), reach_2[2]);
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
        result |= gap[i] > 0 && square[i] > min_axis_square && gap[i] * gap[i] > reach * reach * square[i];
    return result;
}

std::size_t BoxEdgeGaps::widest(double min_gap) const {
    std::size_t best = 9;
    double maximum = signed_square(min_gap);
    for (std::size_t i = 0; i < 9; ++i) {
        const double here = signed_square(gap[i]);
        if (!(here > maximum * square[i]) || square[i] <= min_axis_square) continue;
        maximum = here / square[i];
        best = i;
    }
    return best;
}

}  // namespace abut::detail
