#pragma once

// Points at the same position.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// For each point, the lowest index of a point at exactly the same position; 0 and -0 are equal. No coordinate is NaN.
/// O(n), except for adversarial hash collisions.
std::vector<std::uint32_t> first_coincident(std::span<const Vec3> points);

}  // namespace abut::detail
