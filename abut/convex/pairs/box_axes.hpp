#pragma once

// The fifteen separating axes of two boxes: the face normals of each, and the cross products of their edges.
// Gottschalk, Lin, Manocha, "OBBTree" (1996). For .cpp files.
//
// The gap along an axis is the separation of the projections; below zero it is minus their overlap. Edge axes are not
// normalised, and neither are their gaps: all comparisons are of squares.

#include <abut/convex/pairs/box_frame.hpp>

namespace abut::detail {

/// The widest gap along a face normal.
struct BoxFaceGap {
    double gap;
    std::size_t number;  ///< 0 to 2: a face of A, 3 to 5: a face of B
};

/// The gaps along the face normals of both. Those of B are added only on demand, because in most cases those of A
/// suffice to separate the boxes.
class BoxFaceGaps {
public:
    [[gnu::always_inline]] BoxFaceGaps(const PlacedBox& a, const PlacedBox& b)
        : half_a_(a.half),
          half_b_(b.half),
          axis_b_{a.axes.transposed(b.axes.first_column()), a.axes.transposed(b.axes.second_column()),
                  a.axes.transposed(b.axes.last_column())},
          middle_(a.axes.transposed(b.center - a.center)),
          sizes_{magnitude(axis_b_[0]), magnitude(axis_b_[1]), magnitude(axis_b_[2])} {
        using namespace lanes;
        const Double3 reach_a =
            half_a_ + sizes_[0] * first(half_b_.xy) + sizes_[1] * second(half_b_.xy) + sizes_[2] * half_b_.z;
        of_a_ = magnitude(middle_) - reach_a;
    }

    /// The gaps of A depend on all numbers of both boxes.
    bool finite() const { return lanes::finite(of_a_.xy + of_a_.z); }
    bool any_wider_than(double reach) const { return is_wider(of_a_, reach) || is_wider(of_b(), reach); }

    BoxFaceGap widest() const {
        using namespace lanes;
        std::array<double, 6> gaps;
        put(of_a_, &gaps[0]);
        put(of_b(), &gaps[3]);
        const auto wider = [&](std::size_t i, std::size_t j) { return gaps[j] > gaps[i] ? j : i; };
        const std::size_t best = wider(wider(wider(0, 1), 2), wider(wider(3, 4), 5));
        return {gaps[best], best};
    }

    BoxFrame frame() const {
        using lanes::put;
        BoxFrame result;
        put(half_a_, result.half_a.data());
        put(half_b_, result.half_b.data());
        for (std::size_t i = 0; i < 3; ++i) put(axis_b_[i], result.axis_b[i].data());
        put(middle_, result.middle.data());
        return result;
    }

private:
    static bool is_wider(const lanes::Double3& gaps, double reach) {
        return lanes::bits(lanes::greater(gaps.xy, gaps.z) > lanes::double2(reach)) != 0;
    }
    lanes::Double3 of_b() const {
        using namespace lanes;
        Double2 gap[3];
        for (std::size_t i = 0; i < 3; ++i) gap[i] = magnitude(dot(axis_b_[i], middle_)) - dot(sizes_[i], half_a_);
        return Double3{lower(gap[0], gap[1]), gap[2]} - half_b_;
    }

    lanes::Double3 half_a_, half_b_, axis_b_[3], middle_;  ///< as in a BoxFrame
    lanes::Double3 sizes_[3], of_a_;
};

/// The gaps along cross products of edges, at 3 * (edge of A) + (edge of B). They are reduced by the rounding error, so
/// that a face wins a tie. Nearly parallel edges have no axis, and no gap.
struct BoxEdgeGaps {
    std::array<double, 9> gap;     ///< times the length of the axis
    std::array<double, 9> square;  ///< of that length
    bool apart;                    ///< some gap is above zero
    bool beats_face;               ///< some gap is wider than that of any face

    BoxEdgeGaps(const BoxFrame& frame, double face_gap);

    /// Whether some gap is wider than `reach`, which is not below zero.
    bool wider_than(double reach) const;
    /// The index of the widest gap; 9 if none is wider than `min_gap`.
    std::size_t widest(double min_gap) const;
};

/// An edge axis of a smaller squared length is nothing but rounding.
inline constexpr double min_axis_square = 1e-12;

/// The cross product of an edge of each, from A to B, of any length.
inline Triple edge_axis(const BoxFrame& frame, std::size_t number) {
    const std::size_t i = number / 3;
    const Triple& edge = frame.axis_b[number % 3];
    Triple axis;
    axis[i] = 0;
    axis[next_axis(i)] = -edge[last_axis(i)];
    axis[last_axis(i)] = edge[next_axis(i)];
    if (dot(axis, frame.middle) < 0)
        for (double& x : axis) x = -x;
    return axis;
}

}  // namespace abut::detail
