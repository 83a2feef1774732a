#include <abut/convex/box_axes.hpp>

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
        double reach = frame.half_b[j];
        for (std::size_t i = 0; i < 3; ++i) reach += std::abs(frame.axis_b[j][i]) * frame.half_a[i];
        gaps[3 + j] = std::abs(dot(frame.axis_b[j], frame.middle)) - reach;
    }
    const auto wider = [&](std::size_t i, std::size_t j) { return gaps[j] > gaps[i] ? j : i; };
    const std::size_t best = wider(wider(wider(0, 1), 2), wider(wider(3, 4), 5));
    return {gaps[best], best};
}

BoxEdgeGaps::BoxEdgeGaps(const BoxFrame& frame, double face_gap) : apart(false), beats_face(false) {
    const double slack = rounding * frame.scale(), face = signed_square(face_gap);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t x = next_axis(i), y = last_axis(i);
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t u = next_axis(j), v = last_axis(j);
            const Triple& edge = frame.axis_b[j];
            const double between = std::abs(frame.middle[y] * edge[x] - frame.middle[x] * edge[y]);
            const double reach_a = frame.half_a[x] * std::abs(edge[y]) + frame.half_a[y] * std::abs(edge[x]);
            const double reach_b =
                frame.half_b[u] * std::abs(frame.axis_b[v][i]) + frame.half_b[v] * std::abs(frame.axis_b[u][i]);
            const double here = between - (reach_a + reach_b) - slack;
            const double length = edge[x] * edge[x] + edge[y] * edge[y];
            gap[3 * i + j] = here;
            square[3 * i + j] = length;
            // Without a branch: which one it is can't be guessed.
            const bool is_axis = length > no_axis;
            apart |= is_axis & (here > 0);
            beats_face |= is_axis & (signed_square(here) > face * length);
        }
    }
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
