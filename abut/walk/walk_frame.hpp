#pragma once

// The frame of a triangle, and weights in it. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/walk/walk_data.hpp>

#include <cstdint>

namespace abut {

/// Where a point of a triangle is: first corner + second * (corner 1 - corner 0) + third * (corner 2 - corner 0).
struct WalkWeights {
    double first = 1, second = 0, third = 0;
};

/// What three weights are of their sum. Those that we give have one of exactly 1.
inline WalkWeights shares(const Vec3& weights) {
    WalkWeights result{static_cast<double>(weights.x), static_cast<double>(weights.y), static_cast<double>(weights.z)};
    const double sum = result.first + result.second + result.third;
    if (sum != 1) {
        result.second /= sum;
        result.third /= sum;
        result.first /= sum;
    }
    return result;
}

/// What weights are counted in: floats hold each multiple of it up to 1.
inline constexpr double walk_grain = 0x1p-24;

/// The nearest weights that are whole multiples of the grain, none below 0, with the sum 1; a weight of 0 stays 0.
inline Vec3 in_grains(double second, double third) {
    constexpr std::int32_t whole = 1 << 24;
    // Not below 0, and not above the whole: also where the place is a rounding error outside of its triangle.
    const auto grains = [](double weight, std::int32_t most) {
        const double scaled = weight * (1 << 24) + 0.5;
        const auto count = static_cast<std::int32_t>(scaled > 0 ? (scaled < whole ? scaled : whole) : 0);
        return count < most ? count : most;
    };
    const std::int32_t c = grains(third, whole), b = grains(second, whole - c), a = whole - b - c;
    constexpr auto grain = static_cast<float>(walk_grain);
    return {static_cast<float>(a) * grain, static_cast<float>(b) * grain, static_cast<float>(c) * grain};
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

/// The plane of a triangle: the origin at corner 0, the first axis towards corner 1, corner 2 above it.
class WalkFrame {
public:
    explicit WalkFrame(const WalkTriangle& walk)
        : walk_(walk),
          along_(DVec<3>(walk.corner[1]) - DVec<3>(walk.corner[0])),
          other_(DVec<3>(walk.corner[2]) - DVec<3>(walk.corner[0])) {}

    DVec<2> to_plane(const DVec<3>& vector) const {
        const double x = dot(along_, vector) * walk_.inverse_width;
        return {x, (dot(other_, vector) - walk_.third * x) * walk_.inverse_height};
    }
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

/// What a step changes of the second and the third weight.
inline DVec<2> in_weights(const WalkTriangle& walk, const DVec<2>& step) {
    const double third = step.y * walk.inverse_height;
    return {(step.x - third * walk.third) * walk.inverse_width, third};
}
}  // namespace abut
