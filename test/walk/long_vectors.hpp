#pragma once

// Vectors of long double, for reference implementations.

#include <glm/vec3.hpp>

namespace abut::test {

using Long = glm::vec<3, long double>;

inline long double product(const Long& a, const Long& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Long turned(const Long& a, const Long& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace abut::test
