// Compiled with -mavx2 (CMakeLists.txt): the headers see a caller with AVX.

#include "upper_halves.hpp"

#include <abut/query/closest.hpp>

namespace abut::bench {

float distance_with_upper_halves_in_use(const Sphere& sphere, const Box3& box) {
    use_upper_halves();
    return closest(sphere, box).distance;
}

float distance_with_upper_halves_cleared(const Sphere& sphere, const Box3& box) {
    use_and_clear_upper_halves();
    return closest(sphere, box).distance;
}

}  // namespace abut::bench
