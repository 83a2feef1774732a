#pragma once

// Callers that leave the upper halves of vector registers in use, compared with callers that don't.

#include "bench.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <vector>

namespace abut::bench {

/// Return with the upper halves in use, and clear after use. Without AVX both do nothing.
void use_upper_halves();
void use_and_clear_upper_halves();

/// closest(sphere, box).distance in a caller compiled for AVX, with the upper halves of vector registers in use or not.
/// Without AVX both are the same.
float distance_with_upper_halves_in_use(const Sphere& sphere, const Box3& box);
float distance_with_upper_halves_cleared(const Sphere& sphere, const Box3& box);

/// Public functions that are compiled in the library.
std::vector<Bench> upper_halves_benches();

}  // namespace abut::bench
