#pragma once

// Two boxes in the frame of the first. For .cpp files.

#include <abut/convex/support.hpp>

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

/// B in the frame of A: the middle of A is the origin, its axes are x, y and z. Lengths are those of the world.
struct BoxFrame {
    Triple half_a, half_b;
    std::array<Triple, 3> axis_b;  ///< of length 1
    Triple middle;                 ///< of B

    BoxFrame() = default;
    BoxFrame(const Convex<3>& a, const Convex<3>& b) {
        const double one_a = 1 / a.scale, one_both = one_a * (1 / b.scale);
        const DVec<3> between = b.place.offset - a.place.offset;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec<3>& axis_a = a.place.column[i];
            half_a[i] = static_cast<double>(a.own[0][static_cast<int>(i)]) * a.scale;
            half_b[i] = static_cast<double>(b.own[0][static_cast<int>(i)]) * b.scale;
            middle[i] = abut::detail::dot(axis_a, between) * one_a;
            for (std::size_t j = 0; j < 3; ++j) axis_b[j][i] = abut::detail::dot(axis_a, b.place.column[j]) * one_both;
        }
    }

    /// For boxes whose placements are rigid.
    BoxFrame(const Affine<3>& a, const Vec3& half_of_a, const Affine<3>& b, const Vec3& half_of_b) {
        const DVec<3> between = b.offset - a.offset;
        for (std::size_t i = 0; i < 3; ++i) {
            half_a[i] = static_cast<double>(half_of_a[static_cast<int>(i)]);
            half_b[i] = static_cast<double>(half_of_b[static_cast<int>(i)]);
            middle[i] = abut::detail::dot(a.column[i], between);
            for (std::size_t j = 0; j < 3; ++j) axis_b[j][i] = abut::detail::dot(a.column[i], b.column[j]);
        }
    }

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

/// Maps vectors from the axes of a box into the world.
struct BoxPlacement {
    const Affine<3>& place;
    double one = 1;  ///< 1 / the scale

    explicit BoxPlacement(const Affine<3>& of_box) : place(of_box) {}
    explicit BoxPlacement(const Convex<3>& box) : place(box.place), one(1 / box.scale) {}

    DVec<3> vector(const Triple& v) const { return place.vector(DVec<3>(v[0] * one, v[1] * one, v[2] * one)); }
};

}  // namespace abut::detail
