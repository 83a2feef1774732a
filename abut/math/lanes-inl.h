#pragma once

// Two doubles side by side, in the vectors that compilers have on every machine: for what is so little that choosing a
// vector unit by a call would cost as much. The answers are those of doubles one by one. For .cpp files.

#include <abut/math/vec.hpp>

#include <bit>
#include <cmath>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace abut {

namespace lanes {

using Both = double __attribute__((vector_size(16)));
using Chosen = long long __attribute__((vector_size(16)));

inline Both both(double a, double b) {
    return Both{a, b};
}
inline Both both(double value) {
    return Both{value, value};
}
/// Where it isn't chosen, 0.
inline Both chosen(Chosen mask, Both v) {
    return reinterpret_cast<Both>(mask & reinterpret_cast<Chosen>(v));
}
/// One bit a lane.
inline std::uint32_t bits(Chosen mask) {
#ifdef __SSE2__
    return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
    return static_cast<std::uint32_t>((mask[0] & 1) | (mask[1] & 2));
#endif
}
inline std::uint32_t lowest_bit(std::uint32_t bits) {
    return static_cast<std::uint32_t>(std::countr_zero(bits));
}
/// Which of them have their sign set.
inline std::uint32_t signs(Both v) {
#ifdef __SSE2__
    return static_cast<std::uint32_t>(_mm_movemask_pd(v));
#else
    return static_cast<std::uint32_t>(std::signbit(v[0]) ? 1 : 0) |
           static_cast<std::uint32_t>(std::signbit(v[1]) ? 2 : 0);
#endif
}
/// Of two floats in memory.
inline Both loaded(const float* numbers) {
#ifdef __SSE2__
    return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(numbers))));
#else
    return both(static_cast<double>(numbers[0]), static_cast<double>(numbers[1]));
#endif
}
/// Of one float in memory, in both lanes from there on.
inline Both loaded_twice(const float& number) {
#ifdef __SSE2__
    const __m128 one = _mm_load_ss(&number);
    return _mm_cvtps_pd(_mm_unpacklo_ps(one, one));
#else
    return both(static_cast<double>(number));
#endif
}
inline Both at(const double* numbers) {
    Both result;
    __builtin_memcpy(&result, numbers, sizeof(result));
    return result;
}
inline void put(Both v, double* numbers) {
    __builtin_memcpy(numbers, &v, sizeof(v));
}
inline Both lower(Both a, Both b) {
    return __builtin_shufflevector(a, b, 0, 2);
}
inline Both upper(Both a, Both b) {
    return __builtin_shufflevector(a, b, 1, 3);
}
inline Both swapped(Both v) {
    return __builtin_shufflevector(v, v, 1, 0);
}
inline Both magnitude(Both v) {
    return reinterpret_cast<Both>(reinterpret_cast<Chosen>(v) & 0x7fffffffffffffff);
}

/// Lane by lane a > b ? a : b, and a < b ? a : b: one instruction each, of which compilers make four.
inline Both greater(Both a, Both b) {
#ifdef __SSE2__
    return _mm_max_pd(a, b);
#else
    return a > b ? a : b;
#endif
}
inline Both lesser(Both a, Both b) {
#ifdef __SSE2__
    return _mm_min_pd(a, b);
#else
    return a < b ? a : b;
#endif
}
/// Where the mask is set `a`, elsewhere `b`.
inline Both chosen(Chosen mask, Both a, Both b) {
    return reinterpret_cast<Both>((reinterpret_cast<Chosen>(a) & mask) | (reinterpret_cast<Chosen>(b) & ~mask));
}
inline Both root(Both v) {
#ifdef __SSE2__
    return _mm_sqrt_pd(v);
#else
    return both(std::sqrt(v[0]), std::sqrt(v[1]));
#endif
}
/// The nearest number from 0 to `most`.
inline Both limited(Both v, Both most) {
    return lesser(greater(v, Both{0, 0}), most);
}

// A vector of the plane, in two lanes.

inline Both first(Both v) {
    return __builtin_shufflevector(v, v, 0, 0);
}
inline Both second(Both v) {
    return __builtin_shufflevector(v, v, 1, 1);
}
/// In both lanes.
inline Both dot(Both a, Both b) {
    const Both products = a * b;
    return products + swapped(products);
}
inline bool finite(Both v) {
    return bits(magnitude(v) <= Both{1.7976931348623157e308, 1.7976931348623157e308}) == 3;
}
/// Whether they differ from 1 by no more than what follows is good for.
inline constexpr double near_one = 1e-5;
inline bool are_near_one(Both squares) {
    return bits(magnitude(squares - Both{1, 1}) < both(near_one)) == 3;
}
inline bool is_near_one(double square) {
    return std::abs(square - 1) < near_one;
}
/// One over the root of squares near 1, as `unit` of a vector takes it.
inline Both inverse_root(Both squares) {
    const Both excess = squares - Both{1, 1};
    return Both{1, 1} - excess * (Both{0.5, 0.5} - Both{0.375, 0.375} * excess);
}
/// Sooner, where no tie hangs on the last digits: it leaves out 3/8 of the square of what they differ by, which is
/// 1e-15 for unit vectors of floats, and 4e-11 at most.
inline Both soon_inverse_root(Both squares) {
    return Both{1.5, 1.5} - Both{0.5, 0.5} * squares;
}
/// The squares of the lengths of two vectors, of each in its lane.
inline Both squared_lengths(Both a, Both b) {
    const Both x = lower(a, b), y = upper(a, b);
    return x * x + y * y;
}
/// As two floats.
inline void store(Both v, float* numbers) {
#ifdef __SSE2__
    _mm_storel_pi(reinterpret_cast<__m64*>(numbers), _mm_cvtpd_ps(v));
#else
    numbers[0] = static_cast<float>(v[0]);
    numbers[1] = static_cast<float>(v[1]);
#endif
}

/// A vector of space: two numbers side by side, and the third in both lanes. Numbers that it is multiplied by are in
/// both lanes too.
struct Spatial {
    Both xy, z;

    Spatial operator+(const Spatial& v) const { return {xy + v.xy, z + v.z}; }
    Spatial operator-(const Spatial& v) const { return {xy - v.xy, z - v.z}; }
    Spatial operator*(Both s) const { return {xy * s, z * s}; }
};
inline Spatial spatial(const glm::vec<3, double>& v) {
    return {both(v.x, v.y), both(v.z)};
}
inline glm::vec<3, double> vector(const Spatial& v) {
    return {v.xy[0], v.xy[1], v.z[0]};
}
/// Of three floats in memory.
inline Spatial loaded(const glm::vec<3, float>& v) {
    return {loaded(&v.x), loaded_twice(v.z)};
}
/// In both lanes.
inline Both dot(const Spatial& a, const Spatial& b) {
    return dot(a.xy, b.xy) + a.z * b.z;
}
inline Spatial magnitude(const Spatial& v) {
    return {magnitude(v.xy), magnitude(v.z)};
}
/// As three floats.
inline void store(const Spatial& v, glm::vec<3, float>& result) {
    store(v.xy, &result.x);
    result.z = static_cast<float>(v.z[0]);
}

}  // namespace lanes
}  // namespace abut
