#pragma once

// Sine, cosine and arctangent with the same bits on every machine, without the C library. For .cpp files.

#include <abut/math/assert.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace abut::detail {

struct SinCos {
    double sin, cos;
};

/// Sine and cosine for |x| <= pi / 4, by Taylor polynomials accurate to one or two ulp. Terms are added in pairs for
/// instruction-level parallelism.
inline SinCos sin_cos_of_small(double x) {
    const double z = x * x, zz = z * z, zzzz = zz * zz;
    const double sine = ((-1 / 6.0 + z * (1 / 120.0)) + zz * (-1 / 5040.0 + z * (1 / 362880.0))) +
                        zzzz * ((-1 / 39916800.0 + z * (1 / 6227020800.0)) + zz * (-1 / 1307674368000.0));
    const double cosine = ((1 / 24.0 + z * (-1 / 720.0)) + zz * (1 / 40320.0 + z * (-1 / 3628800.0))) +
                          zzzz * ((1 / 479001600.0 + z * (-1 / 87178291200.0)) + zz * (1 / 20922789888000.0));
    return {x + x * (z * sine), 1 + (zz * cosine - 0.5 * z)};
}

/// Sine and cosine of an angle in radians, after reduction by quarter turns. NaN and infinity trip ABUT_ASSERT and
/// count as zero. Beyond a million turns the reduced angle loses accuracy.
inline SinCos sin_cos(double radians) {
    ABUT_ASSERT(std::isfinite(radians));
    if (!std::isfinite(radians)) return {0, 1};
    constexpr double half_pi_high = 1.57079632673412561417e+00;  // the first 33 bits of pi / 2
    constexpr double half_pi_low = 6.07710050650619224932e-11;   // pi / 2 minus the first 33 bits
    constexpr double max_quarters = 1e15, whole_numbers = 0x1.8p52;
    // Adding this number rounds to an integer, whose last bits are those of the sum.
    const double shifted =
        std::clamp(radians * (2 / 3.14159265358979323846), -max_quarters, max_quarters) + whole_numbers;
    const double quarters = shifted - whole_numbers;
    const double rest = (radians - quarters * half_pi_high) - quarters * half_pi_low;
    const SinCos s = sin_cos_of_small(std::abs(quarters) < max_quarters ? rest : 0);
    // Branch-free, since the quarter is unpredictable.
    const std::uint64_t quarter = std::bit_cast<std::uint64_t>(shifted);
    const double sine_sign = (quarter & 2) != 0 ? -1 : 1, cosine_sign = ((quarter + 1) & 2) != 0 ? -1 : 1;
    const bool odd = (quarter & 1) != 0;
    return {sine_sign * (odd ? s.cos : s.sin), cosine_sign * (odd ? s.sin : s.cos)};
}

/// atan2(sine, cosine), from -pi to pi, of a nonzero vector. The initial approximation, accurate to 1e-5 (Hastings,
/// "Approximations for digital computers", 1955), is corrected by the sine of its error; the remaining error is of
/// third order.
inline double angle_of(double cosine, double sine) {
    constexpr double pi = 3.14159265358979323846;
    const double x = std::abs(cosine), y = std::abs(sine);
    const double larger = std::max(x, y), smaller = std::min(x, y);
    const double t = smaller / larger, tt = t * t;
    const double guess = t * (0.9998660 + tt * (-0.3302995 + tt * (0.1801410 + tt * (-0.0851330 + tt * 0.0208351))));
    const SinCos at = sin_cos_of_small(guess);
    double angle = guess + (t * at.cos - at.sin) / square_root(1 + tt);
    if (y > x) angle = 0.5 * pi - angle;
    if (cosine < 0) angle = pi - angle;
    return sine < 0 ? -angle : angle;
}

}  // namespace abut::detail
