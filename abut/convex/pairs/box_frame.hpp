#pragma once

// Two boxes in the frame of the first. For .cpp files.

#include <abut/convex/pairs/placed_cores.hpp>

namespace abut::detail {

using Triple = std::array<double, 3>;

inline double dot(const Triple& a, const Triple& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The axes after and before axis i, in cyclic order.
constexpr std::size_t next_axis(std::size_t i) {
    return i == 2 ? 0 : i + 1;
}
constexpr std::size_t last_axis(std::size_t i) {
    return i == 0 ? 2 : i - 1;
}

/// From components: a vector loaded as a whole right after its components were written stalls.
inline lanes::Double3 in_lanes(const Triple& v) {
    return {lanes::double2(v[0], v[1]), lanes::double2(v[2])};
}

/// B in the frame of A: the middle of A is the origin, its axes are x, y and z. Lengths are those of the world.
struct BoxFrame {
    Triple half_a, half_b;
    std::array<Triple, 3> axis_b;  ///< of length 1
    Triple middle;                 ///< of B

    /// The components of a vector along the axes of B.
    Triple along_b(const Triple& v) const { return {dot(axis_b[0], v), dot(axis_b[1], v), dot(axis_b[2], v)}; }

    /// A in the frame of B.
    BoxFrame swapped() const {
        BoxFrame result;
        result.half_a = half_b;
        result.half_b = half_a;
        const Triple seen = along_b(middle);
        for (std::size_t i = 0; i < 3; ++i) {
            result.middle[i] = -seen[i];
            for (std::size_t j = 0; j < 3; ++j) result.axis_b[j][i] = axis_b[i][j];
        }
        return result;
    }

    /// An upper bound of all coordinates.
    double scale() const {
        return half_a[0] + half_a[1] + half_a[2] + half_b[0] + half_b[1] + half_b[2] + std::abs(middle[0]) +
               std::abs(middle[1]) + std::abs(middle[2]);
    }
};

}  // namespace abut::detail
