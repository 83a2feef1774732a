#pragma once

// 16-bit floats (IEEE 754 binary16) for textures. For .cpp files.

#include <bit>
#include <cstdint>

namespace abut::detail {

/// Rounds to nearest, ties to even; too large values become infinite. The value is not NaN.
inline std::uint16_t half_of(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value), sign = bits >> 16 & 0x8000u;
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude >= 0x47800000u) return static_cast<std::uint16_t>(sign | 0x7c00u);  // 65536 and more
    if (magnitude < 0x38800000u) {
        // Halves below 2^-14 are multiples of 2^-24, the last place of 0.5: adding 0.5 rounds to one of them.
        const std::uint32_t sum = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f);
        return static_cast<std::uint16_t>(sign | (sum - std::bit_cast<std::uint32_t>(0.5f)));
    }
    const std::uint32_t odd = magnitude >> 13 & 1u;
    const std::uint32_t rounded = (magnitude + 0xfffu + odd) >> 13;
    return static_cast<std::uint16_t>(sign | (rounded - (112u << 10)));
}

/// Exact. The half is not NaN.
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

}  // namespace abut::detail
