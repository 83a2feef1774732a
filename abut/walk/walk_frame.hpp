#pragma once

// The frame of a triangle, and weights in it. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/lanes-inl.h>
#include <abut/walk/walk_data.hpp>

#include <algorithm>
#include <cstdint>

namespace abut {

/// Where a point of a triangle is: first corner + second * (corner 1 - corner 0) + third * (corner 2 - corner 0).
struct WalkWeights {
    double first = 1, second = 0, third = 0;

    double of(std::uint32_t corner) const { return corner == 0 ? first : (corner == 1 ? second : third); }
};

/// What three weights are of their sum. Those that we give have one of exactly 1.
inline WalkWeights shares(const Vec3& weights) {
    const double second = static_cast<double>(weights.y), third = static_cast<double>(weights.z);
    if (weights.x + weights.y + weights.z == 1) return {1 - second - third, second, third};
    const double first = static_cast<double>(weights.x), sum = first + second + third;
    return {first / sum, second / sum, third / sum};
}

/// What weights are counted in: floats hold each multiple of it up to 1.
inline constexpr double walk_grain = 0x1p-24;

/// The nearest weights that are whole multiples of the grain, none below 0, with the sum 1; a weight of 0 stays 0. Also
/// of a place that is a rounding error outside of its triangle.
inline Vec3 in_grains(double second, double third) {
    constexpr std::int32_t whole = 1 << 24;
    const auto grains = [](double weight) {
        return static_cast<std::int32_t>(std::min(std::max(0.0, weight * whole + 0.5), double{whole}));
    };
    const std::int32_t c = grains(third), b = std::min(grains(second), whole - c), a = whole - b - c;
    constexpr auto grain = static_cast<float>(walk_grain);
    return {static_cast<float>(a) * grain, static_cast<float>(b) * grain, static_cast<float>(c) * grain};
}
inline Vec3 in_grains(const WalkWeights& weights) {
    return in_grains(weights.second, weights.third);
}

/// On side k, this share of it away from corner k: the weight opposite of it is exactly 0.
inline Vec3 on_side(std::uint32_t side, double share) {
    const Vec3 weights = in_grains(share, 0);
    const std::uint32_t end = next_corner(side);
    Vec3 result;
    result[static_cast<glm::length_t>(side)] = weights.x;
    result[static_cast<glm::length_t>(end)] = weights.y;
    result[static_cast<glm::length_t>(next_corner(end))] = 0;
    return result;
}

/// Where a place is.
inline DVec<3> in_space(const WalkTriangle& walk, const WalkPoint& place) {
    const WalkWeights weights = shares(place.weights);
    const DVec<3> first(walk.corner[0]);
    return first + (DVec<3>(walk.corner[1]) - first) * weights.second +
           (DVec<3>(walk.corner[2]) - first) * weights.third;
}

/// The plane of a triangle: the origin at corner 0, the first axis towards corner 1, corner 2 above it.
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

/// A vector of space, in the frame of a triangle.
inline DVec<2> to_plane_of(const WalkTriangle& walk, const lanes::Spatial& v) {
    const lanes::Spatial first = lanes::loaded(walk.corner[0]);
    const lanes::Spatial along = lanes::loaded(walk.corner[1]) - first, other = lanes::loaded(walk.corner[2]) - first;
    const double x = lanes::dot(along, v)[0] * walk.inverse_width;
    return {x, (lanes::dot(other, v)[0] - walk.third * x) * walk.inverse_height};
}
inline DVec<2> to_plane_of(const WalkTriangle& walk, const Vec3& vector) {
    return to_plane_of(walk, lanes::loaded(vector));
}

/// Where the corner beyond a side is, unfolded into the plane in which the side has these ends, as one leaves by it.
inline lanes::Both corner_beyond(const WalkTriangle& walk, std::uint32_t side, bool mirrored, lanes::Both left,
                                 lanes::Both right) {
    const lanes::Both across = left - right;
    const double back = mirrored ? -walk.back[side] : walk.back[side], away = walk.away[side];
    return 0.5 * (right + left) - back * across + lanes::Both{away, -away} * lanes::swapped(across);
}

/// After a step in the triangle's plane.
inline WalkWeights stepped(const WalkTriangle& walk, const WalkWeights& from, const DVec<2>& step) {
    const double third = step.y * walk.inverse_height, second = (step.x - third * walk.third) * walk.inverse_width;
    return {from.first - second - third, from.second + second, from.third + third};
}
/// In the triangle, or as little outside as is lost in grains.
inline bool is_within(const WalkWeights& weights) {
    constexpr double outside = -0.5 * walk_grain;
    return std::min(std::min(weights.first, weights.second), weights.third) >= outside;
}

}  // namespace abut
