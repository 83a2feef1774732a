#pragma once

// Four floats side by side, in the vectors that compilers have on every machine: for what is so little that choosing a
// vector unit by a call would cost as much. The answers are those of floats one by one. For .cpp files.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace abut::four {

using Floats = float __attribute__((vector_size(16)));
using Mask = std::int32_t __attribute__((vector_size(16)));

inline Floats all(float x) {
    return Floats{x, x, x, x};
}
inline Floats loaded(const float* numbers) {
    Floats result;
    std::memcpy(&result, numbers, sizeof(result));
    return result;
}
/// The lanes behind the first, or the second; the last lanes hold anything.
inline Floats from_second(Floats v) {
    return __builtin_shufflevector(v, v, 1, 2, 3, 3);
}
inline Floats from_third(Floats v) {
    return __builtin_shufflevector(v, v, 2, 3, 2, 3);
}
/// The second, where it is no number.
inline Floats greater(Floats a, Floats b) {
#ifdef __SSE2__
    return _mm_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
/// The second, where it is no number.
inline Floats less(Floats a, Floats b) {
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
/// One bit a lane.
inline std::uint32_t bits(Mask mask) {
#ifdef __SSE2__
    return static_cast<std::uint32_t>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#else
    return static_cast<std::uint32_t>((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
inline float greatest(Floats v) {
    const Floats two = greater(v, from_third(v));
    return greater(two, from_second(two))[0];
}
inline float least(Floats v) {
    const Floats two = less(v, from_third(v));
    return less(two, from_second(two))[0];
}

}  // namespace abut::four
