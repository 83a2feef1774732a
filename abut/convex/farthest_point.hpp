#pragma once

// The farthest of many points along a direction: what a search on polytopes spends its time on.

#include <abut/math/vec.hpp>

#include <cstdint>
#include <span>

namespace abut {

/// The index of the point with the largest dot product, worked out in double as x + y (+ z); of several the lowest.
/// There is at least one point. As many at a time as the machine's vectors hold, and the same answer whatever that is.
std::uint32_t farthest_point(std::span<const Vec2> points, const DVec<2>& direction);
std::uint32_t farthest_point(std::span<const Vec3> points, const DVec<3>& direction);

}  // namespace abut
