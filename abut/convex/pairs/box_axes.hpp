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

/// The widest of the gaps of all face normals.
inline BoxFaceGap widest_of(const std::array<double, 6>& gaps) {
    const auto wider = [&](std::size_t i, std::size_t j) { return gaps[j] > gaps[i] ? j : i; };
    const std::size_t best = wider(wider(wider(0, 1), 2), wider(wider(3, 4), 5));
    return {gaps[best], best};
}

BoxFaceGap widest_face_gap(const BoxFrame& frame);

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
