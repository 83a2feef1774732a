#pragma once

// Sine, cosine and the angle that has them: the same bits on every machine, with nothing of the C library that rounds
// as it likes. For .cpp files.

#include <abut/math/assert.hpp>

#include <cmath>

namespace abut {

struct SinCos {
    double sin, cos;
};

/// Of an angle that is at most an eighth of a turn off zero, by its Taylor polynomials: right to the last digit or two.
/// The terms are added in pairs and pairs of pairs, so that they don't wait for one another.
inline SinCos sin_cos_of_small(double x) {
    const double z = x * x, zz = z * z, zzzz = zz * zz;
    const double sine = ((-1 / 6.0 + z * (1 / 120.0)) + zz * (-1 / 5040.0 + z * (1 / 362880.0))) +
                        zzzz * ((-1 / 39916800.0 + z * (1 / 6227020800.0)) + zz * (-1 / 1307674368000.0));
    const double cosine = ((1 / 24.0 + z * (-1 / 720.0)) + zz * (1 / 40320.0 + z * (-1 / 3628800.0))) +
                          zzzz * ((1 / 479001600.0 + z * (-1 / 87178291200.0)) + zz * (1 / 20922789888000.0));
    return {x + x * (z * sine), 1 + (zz * cosine - 0.5 * z)};
}

/// Of an angle in radians, after taking off quarter turns. NaN and infinity trip ABUT_ASSERT, and count as zero.
inline SinCos sin_cos(double radians) {
    constexpr double quarter = 0.785398163397448;
    if (std::abs(radians) < quarter) return sin_cos_of_small(radians);
    ABUT_ASSERT(std::isfinite(radians));
    if (!std::isfinite(radians)) return {0, 1};
    constexpr double half_pi_high = 1.57079632673412561417e+00;  // the first 33 bits of pi / 2
    constexpr double half_pi_low = 6.07710050650619224932e-11;   // what they leave
    const double quarters = std::nearbyint(radians / (half_pi_high + half_pi_low));
    const SinCos s = sin_cos_of_small((radians - quarters * half_pi_high) - quarters * half_pi_low);
    switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
        case 0:
            return s;
        case 1:
            return {s.cos, -s.sin};
        case 2:
            return {-s.sin, -s.cos};
        default:
            return {-s.cos, s.sin};
    }
}

/// The angle from -pi to pi of a vector of any length but zero. A first guess, right to 0.005, is set right by what its
/// own sine and cosine leave of the vector; each time the error goes down to a sixth of its third power.
inline double angle_of(double cosine, double sine) {
    constexpr double pi = 3.14159265358979323846;
    const double length = std::sqrt(cosine * cosine + sine * sine);
    const double c = cosine / length, s = sine / length;
    const double x = std::abs(c), y = std::abs(s);
    const double slope = x > y ? y / x : x / y;
    double angle = slope * (0.25 * pi + 0.273 * (1 - slope));
    if (y >= x) angle = 0.5 * pi - angle;
    if (c < 0) angle = pi - angle;
    if (s < 0) angle = -angle;
    for (int round = 0; round < 2; ++round) {
        const SinCos at = sin_cos(angle);
        angle += s * at.cos - c * at.sin;
    }
    return angle;
}

}  // namespace abut
