#pragma once

// Random numbers with identical values on every machine. They use no distribution of the standard library and no libm.

#include <abut/math/dvec.hpp>
#include <abut/math/pose.hpp>
#include <abut/math/simd/square_root.hpp>

#include <cmath>
#include <cstdint>

namespace abut::oracle {

using detail::dot;
using detail::DVec;
using detail::length;
using detail::unit;

/// splitmix64 (Steele, Lea, Flood 2014). A copy repeats the numbers.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        state_ += 0x9e3779b97f4a7c15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    float uniform_float(double low, double high) { return static_cast<float>(uniform(low, high)); }
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(unit() * static_cast<double>(count)); }
    bool chance(double probability) { return unit() < probability; }
    /// From 2^low to 2^high, about uniform in the exponent.
    double power_of_two(int low, int high) {
        const int whole = low + static_cast<int>(below(static_cast<std::uint32_t>(high - low)));
        return std::ldexp(uniform(1, 2), whole);
    }

    template <int D>
    DVec<D> in_cube() {
        DVec<D> result;
        for (int i = 0; i < D; ++i) result[i] = uniform(-1, 1);
        return result;
    }
    /// Uniform over all directions.
    template <int D>
    DVec<D> direction() {
        for (;;) {
            const DVec<D> v = in_cube<D>();
            const double norm = length(v);
            if (norm > 0.1 && norm < 1) return v / norm;
        }
    }
    template <int D>
    Rotation<D> rotation() {
        if constexpr (D == 2) {
            const DVec<2> u = direction<2>();
            return {static_cast<float>(u.x), static_cast<float>(u.y)};
        } else {
            for (;;) {
                const DVec<2> u = in_cube<2>(), v = in_cube<2>();
                const double norm = detail::square_root(dot(u, u) + dot(v, v));
                if (norm > 0.1 && norm < 1)
                    return glm::quat(static_cast<float>(u.x / norm), static_cast<float>(u.y / norm),
                                     static_cast<float>(v.x / norm), static_cast<float>(v.y / norm));
            }
        }
    }

private:
    std::uint64_t state_;
};

}  // namespace abut::oracle
