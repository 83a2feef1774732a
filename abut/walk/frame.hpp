#pragma once

// The frame of a triangle, and barycentric coordinates. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/simd/double2-inl.h>
#include <abut/walk/data.hpp>

#include <algorithm>
#include <cstdint>

namespace abut::detail {

/// Barycentric coordinates of a point: corner 0 + second * (corner 1 - corner 0) + third * (corner 2 - corner 0).
struct WalkWeights {
    double first = 1, second = 0, third = 0;

    double of(std::uint32_t corner) const { return corner == 0 ? first : (corner == 1 ? second : third); }
};

/// Scales three weights to the sum 1. Weights that a walk mesh returned have exactly this sum.
inline WalkWeights normalised_weights(const Vec3& weights) {
    const double second = static_cast<double>(weights.y), third = static_cast<double>(weights.z);
    if (weights.x + weights.y + weights.z == 1) return {1 - second - third, second, third};
    const double first = static_cast<double>(weights.x), sum = first + second + third;
    return {first / sum, second / sum, third / sum};
}

/// The quantum of weights: floats up to 1 represent every multiple of it.
inline constexpr double weight_step = 0x1p-24;

/// Rounds weights to multiples of the quantum, none negative, with the exact sum 1. A weight of 0 stays 0. The point
/// may be outside the triangle by rounding.
inline Vec3 quantised_weights(double second, double third) {
    constexpr std::int32_t total = 1 << 24;
    const auto steps = [](double weight) {
        return static_cast<std::int32_t>(std::min(std::max(0.0, weight * total + 0.5), double{total}));
    };
    const std::int32_t c = steps(third), b = std::min(steps(second), total - c), a = total - b - c;
    constexpr auto step = static_cast<float>(weight_step);
    return {static_cast<float>(a) * step, static_cast<float>(b) * step, static_cast<float>(c) * step};
}
inline Vec3 quantised_weights(const WalkWeights& weights) {
    return quantised_weights(weights.second, weights.third);
}

/// The weights of a point on side k, at this fraction of it from corner k. The opposite weight is exactly 0.
inline Vec3 weights_on_side(std::uint32_t side, double fraction) {
    const Vec3 weights = quantised_weights(fraction, 0);
    const std::uint32_t end = next_corner(side);
    Vec3 result;
    result[static_cast<glm::length_t>(side)] = weights.x;
    result[static_cast<glm::length_t>(end)] = weights.y;
    result[static_cast<glm::length_t>(next_corner(end))] = 0;
    return result;
}

/// The position of a place in space.
inline DVec<3> position_of(const WalkTriangle& walk, const WalkPoint& place) {
    const WalkWeights weights = normalised_weights(place.weights);
    const DVec<3> first(walk.corner[0]);
    return first + (DVec<3>(walk.corner[1]) - first) * weights.second +
           (DVec<3>(walk.corner[2]) - first) * weights.third;
}

/// The frame of a triangle: the origin is corner 0, corner 1 lies on the first axis, and corner 2 above it.
class WalkFrame {
public:
    explicit WalkFrame(const WalkTriangle& walk)
        : walk_(walk),
          along_(DVec<3>(walk.corner[1]) - DVec<3>(walk.corner[0])),
          other_(DVec<3>(walk.corner[2]) - DVec<3>(walk.corner[0])) {}

    DVec<3> first_axis() const { return along_ * walk_.inverse_width; }
    DVec<3> second_axis() const { return (other_ - first_axis() * walk_.third) * walk_.inverse_height; }
    DVec<3> to_space(const DVec<2>& vector) const { return first_axis() * vector.x + second_axis() * vector.y; }
    DVec<3> normal() const { return normalized(cross(along_, other_)); }
    DVec<2> corner(std::uint32_t i) const {
        if (i == 0) return DVec<2>(0.0);
        return i == 1 ? DVec<2>(1 / walk_.inverse_width, 0) : DVec<2>(walk_.third, 1 / walk_.inverse_height);
    }

private:
    const WalkTriangle& walk_;
    DVec<3> along_, other_;
};

/// A vector of space in the frame of a triangle.
inline DVec<2> to_plane_of(const WalkTriangle& walk, const lanes::Double3& v) {
    const lanes::Double3 first = lanes::loaded(walk.corner[0]);
    const lanes::Double3 along = lanes::loaded(walk.corner[1]) - first, other = lanes::loaded(walk.corner[2]) - first;
    const double x = lanes::dot(along, v)[0] * walk.inverse_width;
    return {x, (lanes::dot(other, v)[0] - walk.third * x) * walk.inverse_height};
}
inline DVec<2> to_plane_of(const WalkTriangle& walk, const Vec3& vector) {
    return to_plane_of(walk, lanes::loaded(vector));
}

/// The opposite corner of the neighbour, unfolded into the plane in which the side has these ends, as seen when
/// leaving.
inline lanes::Double2 corner_beyond(const WalkTriangle& walk, std::uint32_t side, bool mirrored, lanes::Double2 left,
                                    lanes::Double2 right) {
    const lanes::Double2 across = left - right;
    const double back = mirrored ? -walk.back[side] : walk.back[side], away = walk.away[side];
    return 0.5 * (right + left) - back * across + lanes::Double2{away, -away} * lanes::swapped(across);
}

/// The weights after a step in the triangle's plane.
inline WalkWeights stepped(const WalkTriangle& walk, const WalkWeights& from, const DVec<2>& step) {
    const double third = step.y * walk.inverse_height, second = (step.x - third * walk.third) * walk.inverse_width;
    return {from.first - second - third, from.second + second, from.third + third};
}
/// True for points in the triangle, or outside by less than half a quantum.
inline bool is_within(const WalkWeights& weights) {
    constexpr double outside = -0.5 * weight_step;
    return std::min(std::min(weights.first, weights.second), weights.third) >= outside;
}

}  // namespace abut::detail
