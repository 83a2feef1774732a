#pragma once

// The area in which a face of one box lies in front of a face of another. For .cpp files.

#include <abut/convex/box_frame.hpp>

namespace abut {

/// The corners of the face of B that looks most against `out`, and of the face of A that looks most along it, of what
/// they have in common seen along `out`; in no order. Corners that coincide may be there twice.
struct BoxPatch {
    static constexpr std::size_t capacity = 12;

    std::size_t axis;                       ///< the face of A is across this one,
    double side;                            ///< at this coordinate
    std::array<double, capacity + 1> x, y;  ///< on A's face, along the axes after `axis`
    std::array<double, capacity + 1> gap;   ///< from there to B's face along `out`
    std::size_t count = 0;

    /// `out` looks from A to B, along the axes of A.
    BoxPatch(const BoxFrame& frame, const Triple& out);

    /// The place on A's face.
    Triple foot(std::size_t i) const {
        Triple result;
        result[axis] = side;
        result[next_axis(axis)] = x[i];
        result[last_axis(axis)] = y[i];
        return result;
    }

    /// The same as long as the same corners and edges make the point.
    std::uint32_t name(std::size_t i) const;

    /// The number of the one with the narrowest gap, `count` where there is none.
    std::size_t nearest() const {
        std::size_t best = 0;
        for (std::size_t i = 1; i < count; ++i) best = gap[i] < gap[best] ? i : best;
        return best;
    }

private:
    std::array<std::uint32_t, capacity + 1>
        made_by_;                           ///< 0 to 7: an edge of B, entering or leaving; 8 on: corners of A
    std::array<std::uint32_t, 4> corners_;  ///< of B's face, by number
    std::uint32_t starts_, by_x_, falls_x_, falls_y_;  ///< bits, by what made them
};

/// The axis that a direction is nearest to.
inline std::size_t steepest(const Triple& v) {
    const Triple steep{std::abs(v[0]), std::abs(v[1]), std::abs(v[2])};
    const std::size_t first = steep[1] > steep[0] ? 1 : 0;
    return steep[2] > steep[first] ? 2 : first;
}

}  // namespace abut
