#pragma once

// A single look-up in SIMD vectors of four. It performs the same operations in the same order as the reference
// implementation `linear_sample`. For .cpp files.

#include <abut/field/look_up/stencil.hpp>
#include <abut/math/simd/float4-inl.h>

#include <bit>
#include <cstring>

namespace abut::detail {

/// Interpolation from distances and gradients, for points in the volume.
FieldSample<2> gradient_sample(const FieldData<2>& data, const Vec2& point);
FieldSample<3> gradient_sample(const FieldData<3>& data, const Vec3& point);
float gradient_distance(const FieldData<2>& data, const Vec2& point);
float gradient_distance(const FieldData<3>& data, const Vec3& point);
/// The reference implementation, corner by corner.
FieldSample<3> gradient_sample_reference(const FieldData<3>& data, const Vec3& point);

namespace field_lanes {

using float4::Floats;
using Ints = float4::Mask;

inline Floats truncated(Floats v) {
    return __builtin_convertvector(__builtin_convertvector(v, Ints), Floats);
}

/// Loads two numbers from each of two places.
[[gnu::always_inline]] inline Floats pairs(const float* a, const float* b) {
#ifdef __SSE2__
    const __m128 low = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(a)));
    return _mm_loadh_pi(low, reinterpret_cast<const __m64*>(b));
#else
    return Floats{a[0], a[1], b[0], b[1]};
#endif
}

/// The distances at the lower and upper ends of a cell's edges along the first axis.
struct Ends {
    Floats low, high;
};
[[gnu::always_inline]] inline Ends ends(const float* at, std::uint32_t row, std::uint32_t slice) {
    const Floats near = pairs(at, at + row), far = pairs(at + slice, at + slice + row);
    return {__builtin_shufflevector(near, far, 0, 2, 4, 6), __builtin_shufflevector(near, far, 1, 3, 5, 7)};
}
[[gnu::always_inline]] inline Ends ends(const std::int16_t* at, std::uint32_t row, std::uint32_t slice) {
    const auto pair = [&](std::size_t i) {
        std::int32_t result;
        std::memcpy(&result, at + i, sizeof(result));
        return result;
    };
    const Ints packed_pair{pair(0), pair(row), pair(slice), pair(std::size_t{slice} + row)};
    const Ints low = packed_pair << 16 >> 16, high = packed_pair >> 16;
    if constexpr (std::endian::native == std::endian::little)
        return {__builtin_convertvector(low, Floats), __builtin_convertvector(high, Floats)};
    else
        return {__builtin_convertvector(high, Floats), __builtin_convertvector(low, Floats)};
}

/// Interpolates along the second axis, in the first two lanes.
[[gnu::always_inline]] inline Floats along_second(Floats v, Floats fraction) {
    const Floats low = __builtin_shufflevector(v, v, 0, 2, 0, 2), high = __builtin_shufflevector(v, v, 1, 3, 1, 3);
    return low + fraction * (high - low);
}

[[gnu::always_inline]] inline float distance_of(const Ends& at, Floats fraction) {
    const Floats first = at.low + __builtin_shufflevector(fraction, fraction, 0, 0, 0, 0) * (at.high - at.low);
    const Floats second = along_second(first, __builtin_shufflevector(fraction, fraction, 1, 1, 1, 1));
    return lerp(second[0], second[1], fraction[2]);
}

/// The distance and its slope along the three axes.
[[gnu::always_inline]] inline Floats distance_and_slope(const Ends& at, Floats fraction) {
    const Floats rise = at.high - at.low;
    const Floats first = at.low + __builtin_shufflevector(fraction, fraction, 0, 0, 0, 0) * rise;
    const Floats fraction_y = __builtin_shufflevector(fraction, fraction, 1, 1, 1, 1);
    const Floats low = __builtin_shufflevector(first, rise, 0, 2, 4, 6);
    const Floats high = __builtin_shufflevector(first, rise, 1, 3, 5, 7);
    const Floats step = high - low;
    const Floats second = low + fraction_y * step;  // near and far: distance, slope along x
    const Floats near = __builtin_shufflevector(second, step, 0, 2, 4, 4);
    const Floats far = __builtin_shufflevector(second, step, 1, 3, 5, 5);
    Floats third = near + __builtin_shufflevector(fraction, fraction, 2, 2, 2, 2) * (far - near);
    third[3] = second[1] - second[0];
    return third;
}

/// The position of a point among the samples, as in FieldStencil.
struct Stencil {
    Floats fraction;
    std::uint32_t first, row, slice;
    bool coarse;
};

[[gnu::always_inline]] inline Stencil stencil(const FieldData<3>& data, Floats point) {
    const FieldFrame<3>& frame = data.frame;
    const Floats place = float4::min((point - float4::load(frame.low.data())) * float4::broadcast(frame.inverse),
                                     float4::load(frame.end.data()));
    const Floats cell = float4::min(truncated(place), float4::load(frame.last.data()));
    const Ints low = __builtin_convertvector(cell, Ints);
    Stencil result{place - cell, 0, 0, 0, false};
    const auto x = static_cast<std::uint32_t>(low[0]), y = static_cast<std::uint32_t>(low[1]),
               z = static_cast<std::uint32_t>(low[2]);
    if (data.store == FieldStore::dense) {
        result.row = frame.stride.y;
        result.slice = frame.stride.z;
        result.first = x + y * result.row + z * result.slice;
        return result;
    }
    constexpr std::uint32_t side = brick_cells<3>;
    const std::uint32_t brick = data.brick[x / side + y / side * frame.block_row.y + z / side * frame.block_row.z];
    if (brick != no_brick) [[likely]] {
        result.row = side + 1;
        result.slice = (side + 1) * (side + 1);
        result.first = brick * brick_samples<3> + x % side + y % side * result.row + z % side * result.slice;
        return result;
    }
    const Ints inside = low & Ints{side - 1, side - 1, side - 1, side - 1};
    result.fraction = (result.fraction + __builtin_convertvector(inside, Floats)) * float4::broadcast(1.0f / side);
    result.row = frame.corners.y;
    result.slice = frame.corners.z;
    result.first = x / side + y / side * result.row + z / side * result.slice;
    result.coarse = true;
    return result;
}

/// False also for NaN.
[[gnu::always_inline]] inline bool within(const FieldFrame<3>& frame, Floats point) {
    return float4::bits((point >= float4::load(frame.low.data())) & (point <= float4::load(frame.high.data()))) == 15;
}

[[gnu::always_inline]] inline float distance(const FieldData<3>& data, Floats point) {
    const Stencil at = stencil(data, point);
    if (!at.coarse && data.step != 0)
        return distance_of(ends(data.steps.data() + at.first, at.row, at.slice), at.fraction) * data.step;
    const float* from = at.coarse ? data.coarse.data() : data.distance.data();
    return distance_of(ends(from + at.first, at.row, at.slice), at.fraction);
}

[[gnu::always_inline]] inline FieldSample<3> sample(const FieldData<3>& data, Floats point) {
    const Stencil at = stencil(data, point);
    Floats found;
    float unit = 1, per_length = data.frame.inverse;
    if (!at.coarse && data.step != 0) {
        found = distance_and_slope(ends(data.steps.data() + at.first, at.row, at.slice), at.fraction);
        unit = data.step;
    } else {
        const float* from = at.coarse ? data.coarse.data() : data.distance.data();
        found = distance_and_slope(ends(from + at.first, at.row, at.slice), at.fraction);
        if (at.coarse) per_length = per_length * (1.0f / brick_cells<3>);
    }
    const float scale = unit * per_length;
    return {found[0] * unit, direction_of(Vec3(found[1] * scale, found[2] * scale, found[3] * scale))};
}

}  // namespace field_lanes

inline float look_up_distance(const FieldData<3>& data, const Vec3& point) {
    const float4::Floats p{point.x, point.y, point.z, 0};
    if (!field_lanes::within(data.frame, p)) [[unlikely]]
        return outer_sample(data, point).distance;
    if (data.lookup == FieldLookup::gradient) [[unlikely]]
        return gradient_distance(data, point);
    return field_lanes::distance(data, p);
}
inline FieldSample<3> look_up_sample(const FieldData<3>& data, const Vec3& point) {
    const float4::Floats p{point.x, point.y, point.z, 0};
    if (!field_lanes::within(data.frame, p)) [[unlikely]]
        return outer_sample(data, point);
    if (data.lookup == FieldLookup::gradient) [[unlikely]]
        return gradient_sample(data, point);
    return field_lanes::sample(data, p);
}

inline float look_up_distance(const FieldData<2>& data, const Vec2& point) {
    if (!contains(volume_of(data), point)) [[unlikely]]
        return outer_sample(data, point).distance;
    if (data.lookup == FieldLookup::gradient) [[unlikely]]
        return gradient_distance(data, point);
    return linear_distance(data, point);
}
inline FieldSample<2> look_up_sample(const FieldData<2>& data, const Vec2& point) {
    if (!contains(volume_of(data), point)) [[unlikely]]
        return outer_sample(data, point);
    if (data.lookup == FieldLookup::gradient) [[unlikely]]
        return gradient_sample(data, point);
    return linear_sample(data, point);
}

template <int D>
void look_up(const FieldData<D>& data, const Vec<D>& point, float& out) {
    out = look_up_distance(data, point);
}
template <int D>
void look_up(const FieldData<D>& data, const Vec<D>& point, FieldSample<D>& out) {
    out = look_up_sample(data, point);
}

}  // namespace abut::detail
