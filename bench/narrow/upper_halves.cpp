// Compiled with -mavx2 (CMakeLists.txt): the headers see a caller with AVX.

#include "upper_halves.hpp"

#include <abut/query/closest.hpp>

namespace abut::bench {

float distance_with_upper_halves_in_use(const Sphere& sphere, const Box3& box) {
#ifdef __AVX__
    asm volatile("vpcmpeqd %%ymm15, %%ymm15, %%ymm15" ::: "xmm15");
#endif
    return closest(sphere, box).distance;
}

float distance_with_upper_halves_cleared(const Sphere& sphere, const Box3& box) {
    return closest(sphere, box).distance;
}

}  // namespace abut::bench
