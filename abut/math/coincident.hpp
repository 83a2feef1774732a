#pragma once

// Points at the same position.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// For each point, the lowest index of a point at exactly its position; 0 and -0 are the same. None is NaN. O(n) but
/// for points that are chosen to collide.
std::vector<std::uint32_t> first_coincident(std::span<const Vec3> points);

}  // namespace abut
