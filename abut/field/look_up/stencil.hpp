#pragma once

// The interpolation stencil of a point, and linear interpolation in it. For .cpp files.

#include <abut/field/data.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace abut::detail {

template <int D>
inline constexpr std::size_t cell_corners = std::size_t{1} << D;

/// The cube of samples around a point: a cell, or a block without a brick.
template <int D>
struct FieldStencil {
    std::uint32_t first = 0;               ///< the sample at its lowest corner
    glm::vec<D, std::uint32_t> stride{1};  ///< from one corner to the next along each axis
    Vec<D> fraction{};                     ///< the point's position in the cube, in [0, 1]
    bool coarse = false;                   ///< the samples are corners of blocks
    glm::vec<D, std::uint32_t> low{};      ///< the cell at its lowest corner

    /// Corner i is the upper one along axis a if bit a of i is set.
    std::uint32_t corner(std::size_t i) const {
        std::uint32_t result = first;
        for (int a = 0; a < D; ++a)
            if (i >> a & 1) result += stride[a];
        return result;
    }
};

template <int D>
Aabb<D> volume_of(const FieldData<D>& data) {
    Aabb<D> result{data.origin, {}};
    for (int a = 0; a < D; ++a) result.max[a] = data.frame.high[static_cast<std::size_t>(a)];
    return result;
}

/// The point is in the volume.
template <int D>
FieldStencil<D> stencil_of(const FieldData<D>& data, const Vec<D>& point) {
    const FieldFrame<D>& frame = data.frame;
    FieldStencil<D> result;
    for (int a = 0; a < D; ++a) {
        const auto lane = static_cast<std::size_t>(a);
        const float place = std::min((point[a] - frame.low[lane]) * frame.inverse, frame.end[lane]);  // in cells
        const float cell = std::min(static_cast<float>(static_cast<std::int32_t>(place)), frame.last[lane]);
        result.fraction[a] = place - cell;
        result.low[a] = static_cast<std::uint32_t>(cell);
    }
    if (data.store == FieldStore::dense) {
        result.stride = frame.stride;
        for (int a = 0; a < D; ++a) result.first += result.low[a] * frame.stride[a];
        return result;
    }

    constexpr std::uint32_t side = brick_cells<D>;
    std::uint32_t block = 0, inside = 0, stride = 1;
    for (int a = 0; a < D; ++a) {
        block += result.low[a] / side * frame.block_row[a];
        inside += result.low[a] % side * stride;
        result.stride[a] = stride;
        stride *= side + 1;
    }
    const std::uint32_t brick = data.brick[block];
    if (brick != no_brick) {
        result.first = brick * brick_samples<D> + inside;
        return result;
    }
    result.coarse = true;
    result.stride = frame.corners;
    for (int a = 0; a < D; ++a) {
        const std::uint32_t in_block = result.low[a] % side;
        result.fraction[a] = (result.fraction[a] + static_cast<float>(in_block)) * (1.0f / side);
        result.low[a] -= in_block;
        result.first += result.low[a] / side * frame.corners[a];
    }
    return result;
}

/// The distances at the corners, in multiples of `unit_of`.
template <int D>
std::array<float, cell_corners<D>> corner_values(const FieldData<D>& data, const FieldStencil<D>& stencil) {
    std::array<float, cell_corners<D>> result;
    if (!stencil.coarse && !data.steps.empty()) {
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<float>(data.steps[stencil.corner(i)]);
    } else {
        const float* from = stencil.coarse ? data.coarse.data() : data.distance.data();
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = from[stencil.corner(i)];
    }
    return result;
}
template <int D>
float unit_of(const FieldData<D>& data, const FieldStencil<D>& stencil) {
    return stencil.coarse || data.steps.empty() ? 1.0f : data.step;
}

inline float lerp(float a, float b, float fraction) {
    return a + fraction * (b - a);
}

/// Multilinear interpolation. The order of the operations determines the bits; batches use the same order.
inline float linear(const std::array<float, 4>& v, const Vec2& fraction) {
    return lerp(lerp(v[0], v[1], fraction.x), lerp(v[2], v[3], fraction.x), fraction.y);
}
inline float linear(const std::array<float, 8>& v, const Vec3& fraction) {
    const float low = lerp(lerp(v[0], v[1], fraction.x), lerp(v[2], v[3], fraction.x), fraction.y);
    const float high = lerp(lerp(v[4], v[5], fraction.x), lerp(v[6], v[7], fraction.x), fraction.y);
    return lerp(low, high, fraction.z);
}

/// The gradient of the interpolation, per cube.
inline Vec2 slope(const std::array<float, 4>& v, const Vec2& fraction) {
    return {lerp(v[1] - v[0], v[3] - v[2], fraction.y), lerp(v[2], v[3], fraction.x) - lerp(v[0], v[1], fraction.x)};
}
inline Vec3 slope(const std::array<float, 8>& v, const Vec3& fraction) {
    const float a = lerp(v[0], v[1], fraction.x), b = lerp(v[2], v[3], fraction.x);
    const float c = lerp(v[4], v[5], fraction.x), d = lerp(v[6], v[7], fraction.x);
    const float low = lerp(v[1] - v[0], v[3] - v[2], fraction.y), high = lerp(v[5] - v[4], v[7] - v[6], fraction.y);
    return {lerp(low, high, fraction.z), lerp(b - a, d - c, fraction.z),
            lerp(c, d, fraction.y) - lerp(a, b, fraction.y)};
}

/// Normalises a gradient. The result is the first axis if its length is below a thousandth.
template <int D>
Vec<D> direction_of(const Vec<D>& slope) {
    float square = slope[0] * slope[0];
    for (int a = 1; a < D; ++a) square = square + slope[a] * slope[a];
    if (!(square > 1e-6f)) {
        Vec<D> result(0.0f);
        result[0] = 1;
        return result;
    }
    const float inverse = 1 / square_root(square);
    Vec<D> result;
    for (int a = 0; a < D; ++a) result[a] = slope[a] * inverse;
    return result;
}

/// The point is in the volume.
template <int D>
float linear_distance(const FieldData<D>& data, const Vec<D>& point) {
    const FieldStencil<D> stencil = stencil_of(data, point);
    return linear(corner_values(data, stencil), stencil.fraction) * unit_of(data, stencil);
}
template <int D>
FieldSample<D> linear_sample(const FieldData<D>& data, const Vec<D>& point) {
    const FieldStencil<D> stencil = stencil_of(data, point);
    const auto values = corner_values(data, stencil);
    const float unit = unit_of(data, stencil);
    const float per_length = stencil.coarse ? data.frame.inverse * (1.0f / brick_cells<D>) : data.frame.inverse;
    return {linear(values, stencil.fraction) * unit,
            direction_of(slope(values, stencil.fraction) * (unit * per_length))};
}

/// The point is outside the volume.
template <int D>
FieldSample<D> outer_sample(const FieldData<D>& data, const Vec<D>& point);

}  // namespace abut::detail
