#pragma once

// The intersection of two faces of two boxes, projected along the contact normal. For .cpp files.

#include <abut/convex/pairs/box_frame.hpp>

namespace abut::detail {

/// The corners of the intersection of the face of B that is most opposed to `out`, and the face of A that faces it
/// most, seen along `out`; in no order. Coincident corners may occur twice.
struct BoxFaceClip {
    static constexpr std::size_t capacity = 12;

    std::size_t axis;                       ///< the face of A is orthogonal to this axis,
    double side;                            ///< at this coordinate
    std::array<double, capacity + 1> x, y;  ///< on A's face, along the axes after `axis`
    std::array<double, capacity + 1> gap;   ///< from there to B's face along `out`
    std::size_t count = 0;

    /// `out` points from A to B, in the axes of A.
    BoxFaceClip(const BoxFrame& frame, const Triple& out);

    /// The point on A's face.
    Triple point_on_face(std::size_t i) const {
        Triple result;
        result[axis] = side;
        result[next_axis(axis)] = x[i];
        result[last_axis(axis)] = y[i];
        return result;
    }

    /// Persistent as long as the same corners and edges make the point.
    std::uint32_t name(std::size_t i) const;

    /// The index of the point with the narrowest gap; `count` if there is none.
    std::size_t nearest() const {
        std::size_t best = 0;
        for (std::size_t i = 1; i < count; ++i) best = gap[i] < gap[best] ? i : best;
        return best;
    }

private:
    std::array<std::uint32_t, capacity + 1>
        made_by_;                           ///< 0 to 7: an edge of B, entering or leaving; from 8: a corner of A
    std::array<std::uint32_t, 4> corners_;  ///< of B's face, by number
    std::uint32_t starts_, by_x_, falls_x_, falls_y_;  ///< bits, by `made_by_`
};

/// The axis with the largest component of a direction.
inline std::size_t steepest(const Triple& v) {
    const Triple steep{std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
    const std::size_t first = steep[1] > steep[0] ? 1 : 0;
    return steep[2] > steep[first] ? 2 : first;
}

}  // namespace abut::detail
