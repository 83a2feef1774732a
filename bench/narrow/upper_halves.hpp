#pragma once

// A caller that is compiled for AVX.

#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

namespace abut::bench {

/// closest(sphere, box).distance, with the upper halves of vector registers dirty or not. Without AVX both are the
/// same.
float distance_with_upper_halves_in_use(const Sphere& sphere, const Box3& box);
float distance_with_upper_halves_cleared(const Sphere& sphere, const Box3& box);

}  // namespace abut::bench
