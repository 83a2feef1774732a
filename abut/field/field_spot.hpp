#pragma once

// Where a point lies among the samples of a field, and what is told from those around it. For .cpp files.

#include <abut/field/field_data.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/distance_function.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut {

template <int D>
inline constexpr std::size_t cell_corners = std::size_t{1} << D;

/// The cube of samples around a point: a cell, or a block without a brick.
template <int D>
struct FieldSpot {
    std::uint32_t first = 0;               ///< the sample of its lowest corner
    glm::vec<D, std::uint32_t> stride{1};  ///< from one corner to the next along each axis
    Vec<D> share{};                        ///< how far along it the point is, in [0, 1]
    bool coarse = false;                   ///< the samples are those of blocks
    glm::vec<D, std::uint32_t> low{};      ///< the cell of its lowest corner

    /// Corner i is the upper one along axis a where bit a of i is set.
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

/// Of a point of the volume.
template <int D>
FieldSpot<D> spot_of(const FieldData<D>& data, const Vec<D>& point) {
    const FieldFrame<D>& frame = data.frame;
    FieldSpot<D> result;
    for (int a = 0; a < D; ++a) {
        const auto lane = static_cast<std::size_t>(a);
        const float place = std::min((point[a] - frame.low[lane]) * frame.inverse, frame.end[lane]);  // in cells
        const float cell = std::min(static_cast<float>(static_cast<std::int32_t>(place)), frame.last[lane]);
        result.share[a] = place - cell;
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
        result.share[a] = (result.share[a] + static_cast<float>(in_block)) * (1.0f / side);
        result.low[a] -= in_block;
        result.first += result.low[a] / side * frame.corners[a];
    }
    return result;
}

/// A multiple of the distances at the corners: of `unit_of` of them.
template <int D>
std::array<float, cell_corners<D>> corner_values(const FieldData<D>& data, const FieldSpot<D>& spot) {
    std::array<float, cell_corners<D>> result;
    if (!spot.coarse && !data.steps.empty()) {
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<float>(data.steps[spot.corner(i)]);
    } else {
        const float* from = spot.coarse ? data.coarse.data() : data.distance.data();
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = from[spot.corner(i)];
    }
    return result;
}
template <int D>
float unit_of(const FieldData<D>& data, const FieldSpot<D>& spot) {
    return spot.coarse || data.steps.empty() ? 1.0f : data.step;
}

inline float between(float a, float b, float share) {
    return a + share * (b - a);
}

/// Linear along each axis. The order of the operations is part of the answer: the vectors of a batch keep it.
inline float linear(const std::array<float, 4>& v, const Vec2& share) {
    return between(between(v[0], v[1], share.x), between(v[2], v[3], share.x), share.y);
}
inline float linear(const std::array<float, 8>& v, const Vec3& share) {
    const float low = between(between(v[0], v[1], share.x), between(v[2], v[3], share.x), share.y);
    const float high = between(between(v[4], v[5], share.x), between(v[6], v[7], share.x), share.y);
    return between(low, high, share.z);
}

/// How it grows along each axis, from corner to corner.
inline Vec2 slope(const std::array<float, 4>& v, const Vec2& share) {
    return {between(v[1] - v[0], v[3] - v[2], share.y), between(v[2], v[3], share.x) - between(v[0], v[1], share.x)};
}
inline Vec3 slope(const std::array<float, 8>& v, const Vec3& share) {
    const float a = between(v[0], v[1], share.x), b = between(v[2], v[3], share.x);
    const float c = between(v[4], v[5], share.x), d = between(v[6], v[7], share.x);
    const float low = between(v[1] - v[0], v[3] - v[2], share.y), high = between(v[5] - v[4], v[7] - v[6], share.y);
    return {between(low, high, share.z), between(b - a, d - c, share.z),
            between(c, d, share.y) - between(a, b, share.y)};
}

/// At length 1. Where it is less than a thousandth there is no direction to speak of: the first axis.
template <int D>
Vec<D> direction_of(const Vec<D>& slope) {
    float square = slope[0] * slope[0];
    for (int a = 1; a < D; ++a) square = square + slope[a] * slope[a];
    if (!(square > 1e-6f)) {
        Vec<D> result(0.0f);
        result[0] = 1;
        return result;
    }
    const float inverse = 1 / std::sqrt(square);
    Vec<D> result;
    for (int a = 0; a < D; ++a) result[a] = slope[a] * inverse;
    return result;
}

/// Of a point of the volume.
template <int D>
float linear_distance(const FieldData<D>& data, const Vec<D>& point) {
    const FieldSpot<D> spot = spot_of(data, point);
    return linear(corner_values(data, spot), spot.share) * unit_of(data, spot);
}
template <int D>
FieldSample<D> linear_sample(const FieldData<D>& data, const Vec<D>& point) {
    const FieldSpot<D> spot = spot_of(data, point);
    const auto values = corner_values(data, spot);
    const float unit = unit_of(data, spot);
    const float per_length = spot.coarse ? data.frame.inverse * (1.0f / brick_cells<D>) : data.frame.inverse;
    return {linear(values, spot.share) * unit, direction_of(slope(values, spot.share) * (unit * per_length))};
}

/// Of a point that isn't within the volume.
template <int D>
FieldSample<D> outer_sample(const FieldData<D>& data, const Vec<D>& point);

}  // namespace abut
