#pragma once

// Floats of 16 bits (IEEE 754 binary16) as textures hold them. For .cpp files.

#include <bit>
#include <cstdint>

namespace abut {

/// Rounded to the nearest, of two the even one; what is too large becomes infinite. The value is a number.
inline std::uint16_t half_of(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value), sign = bits >> 16 & 0x8000u;
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude >= 0x47800000u) return static_cast<std::uint16_t>(sign | 0x7c00u);  // 65536 and more
    if (magnitude < 0x38800000u) {
        // Below 2^-14 halves are multiples of 2^-24: adding 0.5, whose last place that is, rounds to one of them.
        const std::uint32_t sum = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f);
        return static_cast<std::uint16_t>(sign | (sum - std::bit_cast<std::uint32_t>(0.5f)));
    }
    const std::uint32_t odd = magnitude >> 13 & 1u;
    const std::uint32_t rounded = (magnitude + 0xfffu + odd) >> 13;
    return static_cast<std::uint16_t>(sign | (rounded - (112u << 10)));
}

/// Exact. The half is a number.
inline float float_of(std::uint16_t half) {
    const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000u) << 16, rest = half & 0x7fffu;
    float magnitude = 0;
    if (rest < 0x400u)
        magnitude = static_cast<float>(rest) * 0x1p-24f;
    else if (rest < 0x7c00u)
        magnitude = std::bit_cast<float>((rest << 13) + (112u << 23));
    else
        magnitude = std::bit_cast<float>(0x7f800000u);
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(magnitude) | sign);
}

}  // namespace abut
