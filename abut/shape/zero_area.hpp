#pragma once

// Triangles that are none.

#include <abut/math/vec.hpp>

namespace abut {

/// True where the corners have no area: two are equal, or all three lie on a line to within 1e-12 of the longest edge.
bool has_zero_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace abut
