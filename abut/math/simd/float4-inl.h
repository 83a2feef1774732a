#pragma once

// Vectors of four floats, by the vector extensions of gcc and clang. They serve functions so short that the dynamic
// dispatch of Highway would cost as much as the work. The results equal those of scalar floats. For .cpp files.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace abut::float4 {

using Floats = float __attribute__((vector_size(16)));
using Mask = std::int32_t __attribute__((vector_size(16)));

inline Floats broadcast(float x) {
    return Floats{x, x, x, x};
}
inline Floats load(const float* numbers) {
    Floats result;
    std::memcpy(&result, numbers, sizeof(result));
    return result;
}
/// Shifts the lanes down by one, or by two. The last lanes are unspecified.
inline Floats from_second(Floats v) {
    return __builtin_shufflevector(v, v, 1, 2, 3, 3);
}
inline Floats from_third(Floats v) {
    return __builtin_shufflevector(v, v, 2, 3, 2, 3);
}
/// Returns b in lanes where either is NaN.
inline Floats max(Floats a, Floats b) {
#ifdef __SSE2__
    return _mm_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
/// Returns b in lanes where either is NaN.
inline Floats min(Floats a, Floats b) {
#ifdef __SSE2__
    return _mm_min_ps(a, b);
#else
    return a < b ? a : b;
#endif
}
inline Floats magnitude(Floats v) {
    constexpr std::int32_t all_but_sign = 0x7fffffff;
    return std::bit_cast<Floats>(std::bit_cast<Mask>(v) & Mask{all_but_sign, all_but_sign, all_but_sign, all_but_sign});
}
/// The sign bits of the lanes, one bit a lane.
inline std::uint32_t bits(Mask mask) {
#ifdef __SSE2__
    return static_cast<std::uint32_t>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#else
    return static_cast<std::uint32_t>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
inline float max_lane(Floats v) {
    const Floats two = max(v, from_third(v));
    return max(two, from_second(two))[0];
}
inline float min_lane(Floats v) {
    const Floats two = min(v, from_third(v));
    return min(two, from_second(two))[0];
}

}  // namespace abut::float4
