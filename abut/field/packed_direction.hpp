#pragma once

// Unit vectors in 16 bits: octahedral encoding, after Meyer, Suessmuth, Sussner, Stamminger and Greiner (2010): "On
// floating-point normal vectors". The error is at most 0.95 degrees in 3D and 0.004 in 2D. For .cpp files.

#include <abut/math/simd/square_root.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace abut::detail {

inline std::uint16_t packed_once(const Vec2& v) {
    const float along = v.x / (std::abs(v.x) + std::abs(v.y));
    const float steps = std::clamp(std::floor(along * 16383.0f + 0.5f), -16383.0f, 16383.0f);
    return static_cast<std::uint16_t>((static_cast<std::int32_t>(steps) + 16384) << 1 | (v.y < 0 ? 1 : 0));
}
inline std::uint16_t packed_once(const Vec3& v) {
    const float sum = std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    float x = v.x / sum, y = v.y / sum;
    if (v.z < 0) {
        const float folded = std::copysign(1 - std::abs(y), x);
        y = std::copysign(1 - std::abs(x), y);
        x = folded;
    }
    const auto steps = [](float part) {
        return static_cast<std::int32_t>(std::clamp(std::floor(part * 127.0f + 0.5f), -127.0f, 127.0f)) & 255;
    };
    return static_cast<std::uint16_t>(steps(x) | steps(y) << 8);
}

template <int D>
Vec<D> unpacked(std::uint16_t bits);
template <>
inline Vec2 unpacked<2>(std::uint16_t bits) {
    const float x = static_cast<float>((bits >> 1) - 16384) * (1.0f / 16383);
    const float y = (bits & 1) != 0 ? std::abs(x) - 1 : 1 - std::abs(x);
    const float inverse = 1 / square_root(x * x + y * y);
    return {x * inverse, y * inverse};
}

template <>
inline Vec3 unpacked<3>(std::uint16_t bits) {
    float x = static_cast<float>(static_cast<std::int8_t>(bits & 255)) * (1.0f / 127);
    float y = static_cast<float>(static_cast<std::int8_t>(bits >> 8)) * (1.0f / 127);
    const float z = 1 - std::abs(x) - std::abs(y);
    // The corners of the square are folded back for the lower half of the octahedron.
    const float fold = std::max(-z, 0.0f);
    x = x - std::copysign(fold, x);
    y = y - std::copysign(fold, y);
    const float inverse = 1 / square_root(x * x + y * y + z * z);
    return {x * inverse, y * inverse, z * inverse};
}

/// Packs a nonzero vector. The encoding is canonical: packing an unpacked vector gives the same bits.
inline std::uint16_t packed(const Vec2& v) {
    return packed_once(unpacked<2>(packed_once(v)));
}
inline std::uint16_t packed(const Vec3& v) {
    return packed_once(unpacked<3>(packed_once(v)));
}

}  // namespace abut::detail
