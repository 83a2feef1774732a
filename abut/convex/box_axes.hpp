#pragma once

// The fifteen separating axes of two boxes: the face normals of each, and the edges of the one across those of the
// other. Gottschalk, Lin, Manocha, "OBBTree" (1996). For .cpp files.
//
// The gap along an axis is how far it parts the boxes; below zero, how far they overlap along it. The axes between
// edges are left as long as they come out, and their gaps with them: all comparisons are of squares.

#include <abut/convex/box_frame.hpp>

namespace abut {

/// The widest gap along the normal of a face.
struct BoxFaceGap {
    double gap;
    std::size_t number;  ///< 0 to 2: of A, 3 to 5: of B
};

/// Of the gaps of all, by their numbers.
inline BoxFaceGap widest_of(const std::array<double, 6>& gaps) {
    const auto wider = [&](std::size_t i, std::size_t j) { return gaps[j] > gaps[i] ? j : i; };
    const std::size_t best = wider(wider(wider(0, 1), 2), wider(wider(3, 4), 5));
    return {gaps[best], best};
}

BoxFaceGap widest_face_gap(const BoxFrame& frame);

/// Gaps along the edges of A across those of B, at 3 * (edge of A) + (edge of B). They are short by what may be
/// rounding, so that faces win where they are as good. Of edges that are all but parallel there is no axis, and no gap.
struct BoxEdgeGaps {
    std::array<double, 9> gap;     ///< in lengths of the axis
    std::array<double, 9> square;  ///< of that length
    bool apart;                    ///< there is one above zero
    bool beats_face;               ///< there is one wider than that of any face

    BoxEdgeGaps(const BoxFrame& frame, double face_gap);

    /// Whether there is one wider than `reach`, which is not below zero.
    bool wider_than(double reach) const;
    /// The number of the widest; 9 where there is none wider than `least`.
    std::size_t widest(double least) const;
};

/// The axis from A to B across an edge of each, by its number, of any length.
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

}  // namespace abut
