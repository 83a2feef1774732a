#pragma once

// Lane types: four floats or 32-bit integers, or two doubles, in a vector register of x86-64, and elsewhere in an array
// that compilers handle as they like. They serve functions so short that the dynamic dispatch of Highway would cost as
// much as the work. Each operation rounds as that of a scalar does. For .cpp files.

#include <abut/math/detail/round_outwards.hpp>
#include <abut/math/simd/square_root.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__SSE2__) || defined(_M_X64)
#define ABUT_SSE2_LANES 1
#include <emmintrin.h>
#else
#define ABUT_SSE2_LANES 0
#endif

namespace abut::lanes {

#if ABUT_SSE2_LANES

/// Four truth values, each by 32 equal bits.
struct Mask4 {
    __m128 raw;

    friend Mask4 operator&(Mask4 a, Mask4 b) { return {_mm_and_ps(a.raw, b.raw)}; }
};
struct Ints4 {
    __m128i raw;

    Ints4() = default;
    Ints4(__m128i v) : raw(v) {}
    Ints4(std::int32_t all) : raw(_mm_set1_epi32(all)) {}
    Ints4(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) : raw(_mm_set_epi32(d, c, b, a)) {}

    std::int32_t operator[](std::size_t i) const { return std::bit_cast<std::array<std::int32_t, 4>>(raw)[i]; }
    friend Ints4 operator&(Ints4 a, Ints4 b) { return _mm_and_si128(a.raw, b.raw); }
    friend Ints4 operator<<(Ints4 v, int bits) { return _mm_slli_epi32(v.raw, bits); }
    friend Ints4 operator>>(Ints4 v, int bits) { return _mm_srai_epi32(v.raw, bits); }
    friend Mask4 operator==(Ints4 a, Ints4 b) { return {_mm_castsi128_ps(_mm_cmpeq_epi32(a.raw, b.raw))}; }
};
struct Floats4 {
    __m128 raw;

    Floats4() = default;
    Floats4(__m128 v) : raw(v) {}
    Floats4(float all) : raw(_mm_set1_ps(all)) {}
    Floats4(float a, float b, float c, float d) : raw(_mm_set_ps(d, c, b, a)) {}

    float operator[](std::size_t i) const { return std::bit_cast<std::array<float, 4>>(raw)[i]; }
    friend Floats4 operator+(Floats4 a, Floats4 b) { return _mm_add_ps(a.raw, b.raw); }
    friend Floats4 operator-(Floats4 a, Floats4 b) { return _mm_sub_ps(a.raw, b.raw); }
    friend Floats4 operator*(Floats4 a, Floats4 b) { return _mm_mul_ps(a.raw, b.raw); }
    friend Floats4 operator/(Floats4 a, Floats4 b) { return _mm_div_ps(a.raw, b.raw); }
    friend Floats4 operator-(Floats4 v) { return _mm_xor_ps(v.raw, _mm_set1_ps(-0.0f)); }
    friend Mask4 operator<=(Floats4 a, Floats4 b) { return {_mm_cmple_ps(a.raw, b.raw)}; }
    friend Mask4 operator>=(Floats4 a, Floats4 b) { return {_mm_cmpge_ps(a.raw, b.raw)}; }
    friend Mask4 operator==(Floats4 a, Floats4 b) { return {_mm_cmpeq_ps(a.raw, b.raw)}; }
};
/// Two truth values, each by 64 equal bits.
struct Mask2 {
    __m128d raw;

    friend Mask2 operator&(Mask2 a, Mask2 b) { return {_mm_and_pd(a.raw, b.raw)}; }
    friend Mask2 operator|(Mask2 a, Mask2 b) { return {_mm_or_pd(a.raw, b.raw)}; }
};
struct Double2 {
    __m128d raw;

    Double2() = default;
    Double2(__m128d v) : raw(v) {}
    Double2(double both) : raw(_mm_set1_pd(both)) {}
    Double2(double a, double b) : raw(_mm_set_pd(b, a)) {}

    double operator[](std::size_t i) const { return std::bit_cast<std::array<double, 2>>(raw)[i]; }
    friend Double2 operator+(Double2 a, Double2 b) { return _mm_add_pd(a.raw, b.raw); }
    friend Double2 operator-(Double2 a, Double2 b) { return _mm_sub_pd(a.raw, b.raw); }
    friend Double2 operator*(Double2 a, Double2 b) { return _mm_mul_pd(a.raw, b.raw); }
    friend Double2 operator/(Double2 a, Double2 b) { return _mm_div_pd(a.raw, b.raw); }
    friend Double2 operator-(Double2 v) { return _mm_xor_pd(v.raw, _mm_set1_pd(-0.0)); }
    friend Mask2 operator<(Double2 a, Double2 b) { return {_mm_cmplt_pd(a.raw, b.raw)}; }
    friend Mask2 operator<=(Double2 a, Double2 b) { return {_mm_cmple_pd(a.raw, b.raw)}; }
    friend Mask2 operator>(Double2 a, Double2 b) { return {_mm_cmpgt_pd(a.raw, b.raw)}; }
    friend Mask2 operator>=(Double2 a, Double2 b) { return {_mm_cmpge_pd(a.raw, b.raw)}; }
    friend Mask2 operator==(Double2 a, Double2 b) { return {_mm_cmpeq_pd(a.raw, b.raw)}; }
};

inline Floats4 at(const float* four) {
    return _mm_loadu_ps(four);
}
inline Ints4 at(const std::uint32_t* four) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(four));
}
/// Two numbers from each of two places.
inline Floats4 pairs_at(const float* a, const float* b) {
    const __m128 low = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(a)));
    return _mm_loadh_pi(low, reinterpret_cast<const __m64*>(b));
}
/// Lanes i and j of a, then lanes k and l of b.
template <int i, int j, int k, int l>
Floats4 shuffled(Floats4 a, Floats4 b) {
    return _mm_shuffle_ps(a.raw, b.raw, _MM_SHUFFLE(l, k, j, i));
}
/// a > b ? a : b, so b where either is NaN.
inline Floats4 greater(Floats4 a, Floats4 b) {
    return _mm_max_ps(a.raw, b.raw);
}
inline Floats4 lesser(Floats4 a, Floats4 b) {
    return _mm_min_ps(a.raw, b.raw);
}
inline Floats4 root(Floats4 v) {
    return _mm_sqrt_ps(v.raw);
}
inline Floats4 magnitude(Floats4 v) {
    return _mm_andnot_ps(_mm_set1_ps(-0.0f), v.raw);
}
/// Changes the sign of a where that of b is set.
inline Floats4 flipped_by(Floats4 a, Floats4 b) {
    return _mm_xor_ps(a.raw, _mm_and_ps(b.raw, _mm_set1_ps(-0.0f)));
}
/// a where the mask is set, else b.
inline Floats4 select(Mask4 mask, Floats4 a, Floats4 b) {
    return _mm_or_ps(_mm_and_ps(mask.raw, a.raw), _mm_andnot_ps(mask.raw, b.raw));
}
/// One bit a lane.
inline std::uint32_t bits(Mask4 mask) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(mask.raw));
}
inline std::uint32_t signs(Floats4 v) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(v.raw));
}
inline Ints4 truncated(Floats4 v) {
    return _mm_cvttps_epi32(v.raw);
}
inline Floats4 converted(Ints4 v) {
    return _mm_cvtepi32_ps(v.raw);
}

inline Double2 at(const double* two) {
    return _mm_loadu_pd(two);
}
/// From an address that is a multiple of 16.
inline Double2 aligned_at(const double* two) {
    return _mm_load_pd(two);
}
inline void put(Double2 v, double* two) {
    _mm_storeu_pd(two, v.raw);
}
/// Two floats as doubles.
inline Double2 loaded(const float* two) {
    return _mm_cvtps_pd(_mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(two))));
}
/// One float as a double, in both lanes.
inline Double2 loaded_twice(const float& number) {
    const __m128 one = _mm_load_ss(&number);
    return _mm_cvtps_pd(_mm_unpacklo_ps(one, one));
}
inline void store(Double2 v, float* two) {
    _mm_storel_pi(reinterpret_cast<__m64*>(two), _mm_cvtpd_ps(v.raw));
}
/// The smallest floats that are not below the lanes of a and of b.
inline Floats4 floats_at_least(Double2 a, Double2 b) {
    const __m128 nearest = _mm_movelh_ps(_mm_cvtpd_ps(a.raw), _mm_cvtpd_ps(b.raw));
    const __m128d a_is_above = _mm_cmplt_pd(_mm_cvtps_pd(nearest), a.raw),
                  b_is_above = _mm_cmplt_pd(_mm_cvtps_pd(_mm_movehl_ps(nearest, nearest)), b.raw);
    const __m128i are_above = _mm_castps_si128(
        _mm_shuffle_ps(_mm_castpd_ps(a_is_above), _mm_castpd_ps(b_is_above), _MM_SHUFFLE(2, 0, 2, 0)));
    const __m128i bits = _mm_castps_si128(nearest), step = _mm_or_si128(_mm_srai_epi32(bits, 31), _mm_set1_epi32(1));
    return _mm_castsi128_ps(_mm_add_epi32(bits, _mm_and_si128(step, are_above)));
}
/// Lane i of a, then lane j of b.
template <int i, int j>
Double2 shuffled(Double2 a, Double2 b) {
    return _mm_shuffle_pd(a.raw, b.raw, i | j << 1);
}
inline Double2 greater(Double2 a, Double2 b) {
    return _mm_max_pd(a.raw, b.raw);
}
inline Double2 lesser(Double2 a, Double2 b) {
    return _mm_min_pd(a.raw, b.raw);
}
inline Double2 root(Double2 v) {
    return _mm_sqrt_pd(v.raw);
}
inline Double2 magnitude(Double2 v) {
    return _mm_andnot_pd(_mm_set1_pd(-0.0), v.raw);
}
inline Double2 flipped_by(Double2 a, Double2 b) {
    return _mm_xor_pd(a.raw, _mm_and_pd(b.raw, _mm_set1_pd(-0.0)));
}
inline Double2 select(Mask2 mask, Double2 a, Double2 b) {
    return _mm_or_pd(_mm_and_pd(mask.raw, a.raw), _mm_andnot_pd(mask.raw, b.raw));
}
/// v where the mask is set, else 0.
inline Double2 select(Mask2 mask, Double2 v) {
    return _mm_and_pd(mask.raw, v.raw);
}
inline Mask2 first(Mask2 mask) {
    return {_mm_unpacklo_pd(mask.raw, mask.raw)};
}
inline std::uint32_t bits(Mask2 mask) {
    return static_cast<std::uint32_t>(_mm_movemask_pd(mask.raw));
}
inline std::uint32_t signs(Double2 v) {
    return static_cast<std::uint32_t>(_mm_movemask_pd(v.raw));
}
/// The bits of `low` are replaced by those of two words at an address that is a multiple of 16.
inline Double2 with_low_bits(Double2 v, std::uint64_t low, const std::uint64_t* words) {
    const __m128i rest = _mm_andnot_si128(_mm_set1_epi64x(static_cast<long long>(low)), _mm_castpd_si128(v.raw));
    return _mm_castsi128_pd(_mm_or_si128(rest, _mm_load_si128(reinterpret_cast<const __m128i*>(words))));
}
inline Double2 without_bits(Double2 v, std::uint64_t low) {
    return _mm_castsi128_pd(_mm_andnot_si128(_mm_set1_epi64x(static_cast<long long>(low)), _mm_castpd_si128(v.raw)));
}

#else

/// The lanes of a mask are 0 or 1.
template <std::size_t n>
struct Mask {
    std::array<std::uint32_t, n> raw;

    friend Mask operator&(Mask a, Mask b) {
        for (std::size_t i = 0; i < n; ++i) a.raw[i] &= b.raw[i];
        return a;
    }
    friend Mask operator|(Mask a, Mask b) {
        for (std::size_t i = 0; i < n; ++i) a.raw[i] |= b.raw[i];
        return a;
    }
};
using Mask4 = Mask<4>;
using Mask2 = Mask<2>;

struct Ints4 {
    std::array<std::int32_t, 4> raw;

    Ints4() = default;
    Ints4(std::int32_t all) : raw{all, all, all, all} {}
    Ints4(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) : raw{a, b, c, d} {}

    std::int32_t operator[](std::size_t i) const { return raw[i]; }
    friend Ints4 operator&(Ints4 a, Ints4 b) {
        for (std::size_t i = 0; i < 4; ++i) a.raw[i] &= b.raw[i];
        return a;
    }
    friend Ints4 operator<<(Ints4 v, int bits) {
        for (std::int32_t& lane : v.raw) lane = lane << bits;
        return v;
    }
    friend Ints4 operator>>(Ints4 v, int bits) {
        for (std::int32_t& lane : v.raw) lane = lane >> bits;
        return v;
    }
    friend Mask4 operator==(Ints4 a, Ints4 b) {
        Mask4 result;
        for (std::size_t i = 0; i < 4; ++i) result.raw[i] = a.raw[i] == b.raw[i];
        return result;
    }
};

template <class T, std::size_t n>
struct Numbers {
    std::array<T, n> raw;

    Numbers() = default;
    Numbers(T all) { raw.fill(all); }
    template <class... Rest>
    requires(sizeof...(Rest) == n - 2) Numbers(T a, T b, Rest... rest) : raw{a, b, static_cast<T>(rest)...} {}

    T operator[](std::size_t i) const { return raw[i]; }
    friend Numbers operator+(Numbers a, Numbers b) {
        for (std::size_t i = 0; i < n; ++i) a.raw[i] += b.raw[i];
        return a;
    }
    friend Numbers operator-(Numbers a, Numbers b) {
        for (std::size_t i = 0; i < n; ++i) a.raw[i] -= b.raw[i];
        return a;
    }
    friend Numbers operator*(Numbers a, Numbers b) {
        for (std::size_t i = 0; i < n; ++i) a.raw[i] *= b.raw[i];
        return a;
    }
    friend Numbers operator/(Numbers a, Numbers b) {
        for (std::size_t i = 0; i < n; ++i) a.raw[i] /= b.raw[i];
        return a;
    }
    friend Numbers operator-(Numbers v) {
        for (T& lane : v.raw) lane = -lane;
        return v;
    }
    template <class Compare>
    static Mask<n> compared(const Numbers& a, const Numbers& b, const Compare& compare) {
        Mask<n> result;
        for (std::size_t i = 0; i < n; ++i) result.raw[i] = compare(a.raw[i], b.raw[i]) ? 1 : 0;
        return result;
    }
    friend Mask<n> operator<(Numbers a, Numbers b) {
        return compared(a, b, [](T x, T y) { return x < y; });
    }
    friend Mask<n> operator<=(Numbers a, Numbers b) {
        return compared(a, b, [](T x, T y) { return x <= y; });
    }
    friend Mask<n> operator>(Numbers a, Numbers b) { return b < a; }
    friend Mask<n> operator>=(Numbers a, Numbers b) { return b <= a; }
    friend Mask<n> operator==(Numbers a, Numbers b) {
        return compared(a, b, [](T x, T y) { return x == y; });
    }
};
using Floats4 = Numbers<float, 4>;
using Double2 = Numbers<double, 2>;

template <class T, std::size_t n>
Numbers<T, n> greater(Numbers<T, n> a, const Numbers<T, n>& b) {
    for (std::size_t i = 0; i < n; ++i) a.raw[i] = a.raw[i] > b.raw[i] ? a.raw[i] : b.raw[i];
    return a;
}
template <class T, std::size_t n>
Numbers<T, n> lesser(Numbers<T, n> a, const Numbers<T, n>& b) {
    for (std::size_t i = 0; i < n; ++i) a.raw[i] = a.raw[i] < b.raw[i] ? a.raw[i] : b.raw[i];
    return a;
}
template <class T, std::size_t n>
Numbers<T, n> root(Numbers<T, n> v) {
    for (T& lane : v.raw) lane = detail::square_root(lane);
    return v;
}
template <class T, std::size_t n>
Numbers<T, n> magnitude(Numbers<T, n> v) {
    for (T& lane : v.raw) lane = std::abs(lane);
    return v;
}
template <class T, std::size_t n>
Numbers<T, n> flipped_by(Numbers<T, n> a, const Numbers<T, n>& b) {
    for (std::size_t i = 0; i < n; ++i) a.raw[i] = std::signbit(b.raw[i]) ? -a.raw[i] : a.raw[i];
    return a;
}
template <class T, std::size_t n>
Numbers<T, n> select(const Mask<n>& mask, Numbers<T, n> a, const Numbers<T, n>& b) {
    for (std::size_t i = 0; i < n; ++i) a.raw[i] = mask.raw[i] != 0 ? a.raw[i] : b.raw[i];
    return a;
}
template <class T, std::size_t n>
Numbers<T, n> select(const Mask<n>& mask, const Numbers<T, n>& v) {
    return select(mask, v, Numbers<T, n>(T{0}));
}
template <std::size_t n>
std::uint32_t bits(const Mask<n>& mask) {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < n; ++i) result |= mask.raw[i] << i;
    return result;
}
template <class T, std::size_t n>
std::uint32_t signs(const Numbers<T, n>& v) {
    std::uint32_t result = 0;
    for (std::size_t i = 0; i < n; ++i) result |= (std::signbit(v.raw[i]) ? 1u : 0u) << i;
    return result;
}
inline Mask2 first(Mask2 mask) {
    return {mask.raw[0], mask.raw[0]};
}

inline Floats4 at(const float* four) {
    return {four[0], four[1], four[2], four[3]};
}
inline Ints4 at(const std::uint32_t* four) {
    const auto lane = [four](std::size_t i) { return static_cast<std::int32_t>(four[i]); };
    return {lane(0), lane(1), lane(2), lane(3)};
}
inline Floats4 pairs_at(const float* a, const float* b) {
    return {a[0], a[1], b[0], b[1]};
}
template <int i, int j, int k, int l>
Floats4 shuffled(const Floats4& a, const Floats4& b) {
    return {a[i], a[j], b[k], b[l]};
}
inline Ints4 truncated(const Floats4& v) {
    return {static_cast<std::int32_t>(v[0]), static_cast<std::int32_t>(v[1]), static_cast<std::int32_t>(v[2]),
            static_cast<std::int32_t>(v[3])};
}
inline Floats4 converted(const Ints4& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), static_cast<float>(v[3])};
}

inline Double2 at(const double* two) {
    return {two[0], two[1]};
}
inline Double2 aligned_at(const double* two) {
    return at(two);
}
inline void put(const Double2& v, double* two) {
    two[0] = v[0];
    two[1] = v[1];
}
inline Double2 loaded(const float* two) {
    return {static_cast<double>(two[0]), static_cast<double>(two[1])};
}
inline Double2 loaded_twice(const float& number) {
    return static_cast<double>(number);
}
inline void store(const Double2& v, float* two) {
    two[0] = static_cast<float>(v[0]);
    two[1] = static_cast<float>(v[1]);
}
inline Floats4 floats_at_least(const Double2& a, const Double2& b) {
    return {detail::float_at_least(a[0]), detail::float_at_least(a[1]), detail::float_at_least(b[0]),
            detail::float_at_least(b[1])};
}
template <int i, int j>
Double2 shuffled(const Double2& a, const Double2& b) {
    return {a[i], b[j]};
}
inline Double2 with_low_bits(Double2 v, std::uint64_t low, const std::uint64_t* words) {
    for (std::size_t i = 0; i < 2; ++i)
        v.raw[i] = std::bit_cast<double>((std::bit_cast<std::uint64_t>(v.raw[i]) & ~low) | words[i]);
    return v;
}
inline Double2 without_bits(Double2 v, std::uint64_t low) {
    for (double& lane : v.raw) lane = std::bit_cast<double>(std::bit_cast<std::uint64_t>(lane) & ~low);
    return v;
}

#endif

inline Double2& operator+=(Double2& a, Double2 b) {
    return a = a + b;
}
inline Double2& operator-=(Double2& a, Double2 b) {
    return a = a - b;
}
inline Double2& operator*=(Double2& a, Double2 b) {
    return a = a * b;
}
inline Mask2& operator|=(Mask2& a, Mask2 b) {
    return a = a | b;
}

inline float greatest_lane(Floats4 v) {
    const Floats4 two = greater(v, shuffled<2, 3, 2, 3>(v, v));
    return greater(two, shuffled<1, 1, 3, 3>(two, two))[0];
}
inline float least_lane(Floats4 v) {
    const Floats4 two = lesser(v, shuffled<2, 3, 2, 3>(v, v));
    return lesser(two, shuffled<1, 1, 3, 3>(two, two))[0];
}

}  // namespace abut::lanes
