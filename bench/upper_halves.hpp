#pragma once

// A caller that is compiled for AVX.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

namespace abut::bench {

/// Closest(sphere, box).distance, where the caller has left the upper halves of its vector registers in use; or not,
/// where the processor has none.
float distance_with_upper_halves_in_use(const Sphere& sphere, const Box3& box);
float distance_with_upper_halves_cleared(const Sphere& sphere, const Box3& box);

}  // namespace abut::bench
