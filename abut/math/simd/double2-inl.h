#pragma once

// Lane types: two doubles in a 128-bit vector of the compiler's vector extension. They are for code too small for
// run-time dispatch. Results equal those of scalar doubles. For .cpp files.

#include <abut/math/vec.hpp>

#include <bit>
#include <cmath>
#include <cstdint>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace abut {

namespace lanes {

using Double2 = double __attribute__((vector_size(16)));
using Mask2 = long long __attribute__((vector_size(16)));

inline Double2 double2(double a, double b) {
    return Double2{a, b};
}
inline Double2 double2(double value) {
    return Double2{value, value};
}
/// v where the mask is set, else 0.
inline Double2 select(Mask2 mask, Double2 v) {
    return reinterpret_cast<Double2>(mask & reinterpret_cast<Mask2>(v));
}
/// The mask as one bit for each lane.
inline std::uint32_t bits(Mask2 mask) {
#ifdef __SSE2__
    return static_cast<std::uint32_t>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
    return static_cast<std::uint32_t>((mask[0] & 1) | (mask[1] & 2));
#endif
}
inline std::uint32_t lowest_bit(std::uint32_t bits) {
    return static_cast<std::uint32_t>(std::countr_zero(bits));
}
/// The sign bits, one bit for each lane.
inline std::uint32_t signs(Double2 v) {
#ifdef __SSE2__
    return static_cast<std::uint32_t>(_mm_movemask_pd(v));
#else
    return static_cast<std::uint32_t>(std::signbit(v[0]) ? 1 : 0) |
           static_cast<std::uint32_t>(std::signbit(v[1]) ? 2 : 0);
#endif
}
/// Loads two floats.
inline Double2 loaded(const float* numbers) {
#ifdef __SSE2__
    return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(numbers))));
#else
    return double2(static_cast<double>(numbers[0]), static_cast<double>(numbers[1]));
#endif
}
/// Loads one float into both lanes.
inline Double2 loaded_twice(const float& number) {
#ifdef __SSE2__
    const __m128 one = _mm_load_ss(&number);
    return _mm_cvtps_pd(_mm_unpacklo_ps(one, one));
#else
    return double2(static_cast<double>(number));
#endif
}
inline Double2 at(const double* numbers) {
    Double2 result;
    __builtin_memcpy(&result, numbers, sizeof(result));
    return result;
}
/// From an address that is a multiple of 16.
inline Double2 aligned_at(const double* numbers) {
    Double2 result;
    __builtin_memcpy(&result, __builtin_assume_aligned(numbers, sizeof(result)), sizeof(result));
    return result;
}
inline void put(Double2 v, double* numbers) {
    __builtin_memcpy(numbers, &v, sizeof(v));
}
inline Double2 lower(Double2 a, Double2 b) {
    return __builtin_shufflevector(a, b, 0, 2);
}
inline Double2 upper(Double2 a, Double2 b) {
    return __builtin_shufflevector(a, b, 1, 3);
}
inline Double2 swapped(Double2 v) {
    return __builtin_shufflevector(v, v, 1, 0);
}
inline Double2 magnitude(Double2 v) {
    return reinterpret_cast<Double2>(reinterpret_cast<Mask2>(v) & 0x7fffffffffffffff);
}

/// Lane-wise a > b ? a : b, and a < b ? a : b. One instruction each; compilers generate four.
inline Double2 greater(Double2 a, Double2 b) {
#ifdef __SSE2__
    return _mm_max_pd(a, b);
#else
    return a > b ? a : b;
#endif
}
inline Double2 lesser(Double2 a, Double2 b) {
#ifdef __SSE2__
    return _mm_min_pd(a, b);
#else
    return a < b ? a : b;
#endif
}
/// a where the mask is set, else b.
inline Double2 select(Mask2 mask, Double2 a, Double2 b) {
    return reinterpret_cast<Double2>((reinterpret_cast<Mask2>(a) & mask) | (reinterpret_cast<Mask2>(b) & ~mask));
}
inline Double2 root(Double2 v) {
#ifdef __SSE2__
    return _mm_sqrt_pd(v);
#else
    return double2(std::sqrt(v[0]), std::sqrt(v[1]));
#endif
}
/// Clamps to [0, high].
inline Double2 limited(Double2 v, Double2 high) {
    return lesser(greater(v, Double2{0, 0}), high);
}

// 2D vectors: x and y in the two lanes.

inline Double2 first(Double2 v) {
    return __builtin_shufflevector(v, v, 0, 0);
}
inline Double2 second(Double2 v) {
    return __builtin_shufflevector(v, v, 1, 1);
}
/// The dot product, in both lanes.
inline Double2 dot(Double2 a, Double2 b) {
    const Double2 products = a * b;
    return products + swapped(products);
}
inline bool finite(Double2 v) {
    const Double2 zero = v - v;
    return bits(zero == zero) == 3;
}
/// The maximum deviation of a square from 1 for the series below.
inline constexpr double near_one = 1e-5;
inline bool are_near_one(Double2 squares) {
    return bits(magnitude(squares - Double2{1, 1}) < double2(near_one)) == 3;
}
inline bool is_near_one(double square) {
    return std::abs(square - 1) < near_one;
}
/// 1 / sqrt for squares near 1, by the series of `unit` for vectors.
inline Double2 inverse_root(Double2 squares) {
    const Double2 excess = squares - Double2{1, 1};
    return Double2{1, 1} - excess * (Double2{0.5, 0.5} - Double2{0.375, 0.375} * excess);
}
/// 1 / sqrt to first order, for results that don't decide ties. It omits 3/8 of the squared deviation: 1e-15 for unit
/// vectors of floats, at most 4e-11.
inline Double2 approximate_inverse_root(Double2 squares) {
    return Double2{1.5, 1.5} - Double2{0.5, 0.5} * squares;
}
/// The squared lengths of two vectors, one in each lane.
inline Double2 squared_lengths(Double2 a, Double2 b) {
    const Double2 x = lower(a, b), y = upper(a, b);
    return x * x + y * y;
}
/// Stores two floats.
inline void store(Double2 v, float* numbers) {
#ifdef __SSE2__
    _mm_storel_pi(reinterpret_cast<__m64*>(numbers), _mm_cvtpd_ps(v));
#else
    numbers[0] = static_cast<float>(v[0]);
    numbers[1] = static_cast<float>(v[1]);
#endif
}

/// A 3D vector: x and y in one pair of lanes, and z in both lanes of another. Scalars are in both lanes too.
struct Double3 {
    Double2 xy, z;

    Double3 operator+(const Double3& v) const { return {xy + v.xy, z + v.z}; }
    Double3 operator-(const Double3& v) const { return {xy - v.xy, z - v.z}; }
    Double3 operator*(Double2 s) const { return {xy * s, z * s}; }
};
inline Double3 double3(const glm::vec<3, double>& v) {
    return {double2(v.x, v.y), double2(v.z)};
}
inline glm::vec<3, double> vector(const Double3& v) {
    return {v.xy[0], v.xy[1], v.z[0]};
}
/// Loads three floats.
inline Double3 loaded(const glm::vec<3, float>& v) {
    return {loaded(&v.x), loaded_twice(v.z)};
}
/// The dot product, in both lanes.
inline Double2 dot(const Double3& a, const Double3& b) {
    return dot(a.xy, b.xy) + a.z * b.z;
}
inline Double3 magnitude(const Double3& v) {
    return {magnitude(v.xy), magnitude(v.z)};
}
/// Stores three floats.
inline void store(const Double3& v, glm::vec<3, float>& result) {
    store(v.xy, &result.x);
    result.z = static_cast<float>(v.z[0]);
}

}  // namespace lanes
}  // namespace abut
