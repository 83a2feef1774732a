#pragma once

// A single look-up in SIMD vectors of four. It performs the same operations in the same order as the reference
// implementation `linear_sample`. For .cpp files.

#include <abut/field/look_up/stencil.hpp>
#include <abut/math/simd/lanes-inl.h>

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

using lanes::Floats4;
using lanes::Ints4;

template <int lane>
Floats4 all(Floats4 v) {
    return lanes::shuffled<lane, lane, lane, lane>(v, v);
}

/// The distances at the lower and upper ends of a cell's edges along the first axis.
struct Ends {
    Floats4 low, high;
};
[[gnu::always_inline]] inline Ends ends(const float* at, std::uint32_t row, std::uint32_t slice) {
    const Floats4 near = lanes::pairs_at(at, at + row), far = lanes::pairs_at(at + slice, at + slice + row);
    return {lanes::shuffled<0, 2, 0, 2>(near, far), lanes::shuffled<1, 3, 1, 3>(near, far)};
}
[[gnu::always_inline]] inline Ends ends(const std::int16_t* at, std::uint32_t row, std::uint32_t slice) {
    const auto pair = [&](std::size_t i) {
        std::int32_t result;
        std::memcpy(&result, at + i, sizeof(result));
        return result;
    };
    const Ints4 packed_pair{pair(0), pair(row), pair(slice), pair(std::size_t{slice} + row)};
    const Ints4 low = packed_pair << 16 >> 16, high = packed_pair >> 16;
    if constexpr (std::endian::native == std::endian::little)
        return {lanes::converted(low), lanes::converted(high)};
    else
        return {lanes::converted(high), lanes::converted(low)};
}

/// Interpolates along the second axis, in the first two lanes.
[[gnu::always_inline]] inline Floats4 along_second(Floats4 v, Floats4 fraction) {
    const Floats4 low = lanes::shuffled<0, 2, 0, 2>(v, v), high = lanes::shuffled<1, 3, 1, 3>(v, v);
    return low + fraction * (high - low);
}

[[gnu::always_inline]] inline float distance_of(const Ends& at, Floats4 fraction) {
    const Floats4 first = at.low + all<0>(fraction) * (at.high - at.low);
    const Floats4 second = along_second(first, all<1>(fraction));
    return lerp(second[0], second[1], fraction[2]);
}

/// The distance and its slope along the three axes.
[[gnu::always_inline]] inline Floats4 distance_and_slope(const Ends& at, Floats4 fraction) {
    const Floats4 rise = at.high - at.low;
    const Floats4 first = at.low + all<0>(fraction) * rise;
    const Floats4 fraction_y = all<1>(fraction);
    const Floats4 low = lanes::shuffled<0, 2, 0, 2>(first, rise);
    const Floats4 high = lanes::shuffled<1, 3, 1, 3>(first, rise);
    const Floats4 step = high - low;
    const Floats4 second = low + fraction_y * step;  // near and far: distance, slope along x
    const Floats4 near = lanes::shuffled<0, 2, 0, 0>(second, step);
    const Floats4 far = lanes::shuffled<1, 3, 1, 1>(second, step);
    const Floats4 change = far - near, third = near + all<2>(fraction) * change;
    // The last lane is the slope along z.
    return lanes::shuffled<0, 1, 0, 2>(third, lanes::shuffled<2, 2, 0, 0>(third, change));
}

/// The position of a point among the samples, as in FieldStencil.
struct Stencil {
    Floats4 fraction;
    std::uint32_t first, row, slice;
    bool coarse;
};

[[gnu::always_inline]] inline Stencil stencil(const FieldData<3>& data, Floats4 point) {
    const FieldFrame<3>& frame = data.frame;
    const Floats4 place =
        lanes::lesser((point - lanes::at(frame.low.data())) * Floats4(frame.inverse), lanes::at(frame.end.data()));
    const Floats4 cell = lanes::lesser(lanes::converted(lanes::truncated(place)), lanes::at(frame.last.data()));
    const Ints4 low = lanes::truncated(cell);
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
    const Ints4 inside = low & Ints4{side - 1, side - 1, side - 1, side - 1};
    result.fraction = (result.fraction + lanes::converted(inside)) * Floats4(1.0f / side);
    result.row = frame.corners.y;
    result.slice = frame.corners.z;
    result.first = x / side + y / side * result.row + z / side * result.slice;
    result.coarse = true;
    return result;
}

/// False also for NaN.
[[gnu::always_inline]] inline bool within(const FieldFrame<3>& frame, Floats4 point) {
    return lanes::bits((point >= lanes::at(frame.low.data())) & (point <= lanes::at(frame.high.data()))) == 15;
}

[[gnu::always_inline]] inline float distance(const FieldData<3>& data, Floats4 point) {
    const Stencil at = stencil(data, point);
    if (!at.coarse && data.step != 0)
        return distance_of(ends(data.steps.data() + at.first, at.row, at.slice), at.fraction) * data.step;
    const float* from = at.coarse ? data.coarse.data() : data.distance.data();
    return distance_of(ends(from + at.first, at.row, at.slice), at.fraction);
}

[[gnu::always_inline]] inline FieldSample<3> sample(const FieldData<3>& data, Floats4 point) {
    const Stencil at = stencil(data, point);
    Floats4 found;
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
    const lanes::Floats4 p{point.x, point.y, point.z, 0};
    if (!field_lanes::within(data.frame, p)) [[unlikely]]
        return outer_sample(data, point).distance;
    if (data.lookup == FieldLookup::gradient) [[unlikely]]
        return gradient_distance(data, point);
    return field_lanes::distance(data, p);
}
inline FieldSample<3> look_up_sample(const FieldData<3>& data, const Vec3& point) {
    const lanes::Floats4 p{point.x, point.y, point.z, 0};
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
