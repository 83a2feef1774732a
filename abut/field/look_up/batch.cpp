// Batched look-ups. Highway compiles this file once for each instruction set and chooses the best one at run time. Each
// lane performs the operations of `linear_sample` in the same order; points outside the volume are evaluated one by
// one.

#include <abut/field/look_up/batch.hpp>
#include <abut/field/look_up/fetch.hpp>
#include <abut/field/look_up/look_up.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/field/look_up/batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After the Highway headers: this part is compiled once for each target.

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using BatchFloats = hn::CappedTag<float, 16>;
using BatchInts = hn::RebindToSigned<BatchFloats>;
using F = hn::Vec<BatchFloats>;
using I = hn::Vec<BatchInts>;
using M = hn::Mask<BatchFloats>;

HWY_INLINE F lerp(F a, F b, F fraction) {
    return hn::Add(a, hn::Mul(fraction, hn::Sub(b, a)));
}

/// The distances at the corners of a cell or block.
template <int D>
struct Corners {
    F v[std::size_t{1} << D];
};
HWY_INLINE F distance_at(const Corners<2>& c, const F* fraction) {
    return lerp(lerp(c.v[0], c.v[1], fraction[0]), lerp(c.v[2], c.v[3], fraction[0]), fraction[1]);
}
HWY_INLINE F distance_at(const Corners<3>& c, const F* fraction) {
    const F low = lerp(lerp(c.v[0], c.v[1], fraction[0]), lerp(c.v[2], c.v[3], fraction[0]), fraction[1]);
    const F high = lerp(lerp(c.v[4], c.v[5], fraction[0]), lerp(c.v[6], c.v[7], fraction[0]), fraction[1]);
    return lerp(low, high, fraction[2]);
}
HWY_INLINE void slope_at(const Corners<2>& c, const F* fraction, F* slope) {
    slope[0] = lerp(hn::Sub(c.v[1], c.v[0]), hn::Sub(c.v[3], c.v[2]), fraction[1]);
    slope[1] = hn::Sub(lerp(c.v[2], c.v[3], fraction[0]), lerp(c.v[0], c.v[1], fraction[0]));
}
HWY_INLINE void slope_at(const Corners<3>& c, const F* fraction, F* slope) {
    const F p = lerp(c.v[0], c.v[1], fraction[0]), q = lerp(c.v[2], c.v[3], fraction[0]);
    const F r = lerp(c.v[4], c.v[5], fraction[0]), s = lerp(c.v[6], c.v[7], fraction[0]);
    const F low = lerp(hn::Sub(c.v[1], c.v[0]), hn::Sub(c.v[3], c.v[2]), fraction[1]);
    const F high = lerp(hn::Sub(c.v[5], c.v[4]), hn::Sub(c.v[7], c.v[6]), fraction[1]);
    slope[0] = lerp(low, high, fraction[2]);
    slope[1] = lerp(hn::Sub(q, p), hn::Sub(s, r), fraction[2]);
    slope[2] = hn::Sub(lerp(r, s, fraction[1]), lerp(p, q, fraction[1]));
}

template <int D>
HWY_INLINE void load(const Vec<D>* points, F* p) {
    const BatchFloats f;
    if constexpr (D == 2)
        hn::LoadInterleaved2(f, &points->x, p[0], p[1]);
    else
        hn::LoadInterleaved3(f, &points->x, p[0], p[1], p[2]);
}
HWY_INLINE void store(const F* v, FieldSample<2>* out) {
    hn::StoreInterleaved3(v[0], v[1], v[2], BatchFloats(), &out->distance);
}
HWY_INLINE void store(const F* v, FieldSample<3>* out) {
    hn::StoreInterleaved4(v[0], v[1], v[2], v[3], BatchFloats(), &out->distance);
}
HWY_INLINE void store(const F* v, float* out) {
    hn::StoreU(v[0], BatchFloats(), out);
}

HWY_INLINE I times(I a, std::uint32_t b) {
    return hn::Mul(a, hn::Set(BatchInts(), static_cast<std::int32_t>(b)));
}
HWY_INLINE void store_indices(I numbers, std::uint32_t* to) {
    hn::Store(numbers, BatchInts(), reinterpret_cast<std::int32_t*>(to));
}

/// Locates one point per lane. Returns true if all are in the volume; others are replaced by its lower corner.
template <int D, bool is_sparse>
HWY_INLINE bool locate(const FieldFrame<D>& frame, const Vec<D>* points, std::size_t at, Batch<D>& batch) {
    constexpr auto side = static_cast<std::int32_t>(brick_cells<D>);
    constexpr int to_block = D == 2 ? 3 : 2;
    static_assert(1 << to_block == side);
    const BatchFloats f;
    const BatchInts w;
    F p[D];
    load<D>(points + at, p);
    M inside = hn::And(hn::Ge(p[0], hn::Set(f, frame.low[0])), hn::Le(p[0], hn::Set(f, frame.high[0])));
    for (std::size_t a = 1; a < D; ++a) {
        inside = hn::And(inside, hn::Ge(p[a], hn::Set(f, frame.low[a])));
        inside = hn::And(inside, hn::Le(p[a], hn::Set(f, frame.high[a])));
    }
    I first = hn::Zero(w), block = hn::Zero(w), corner = hn::Zero(w);
    std::uint32_t stride = 1;
    for (std::size_t a = 0; a < D; ++a) {
        const auto axis = static_cast<glm::length_t>(a);
        const F low = hn::Set(f, frame.low[a]);
        const F offset = hn::Sub(hn::IfThenElse(inside, p[a], low), low);
        const F there = hn::Min(hn::Mul(offset, hn::Set(f, frame.inverse)), hn::Set(f, frame.end[a]));
        const F truncated = hn::Min(hn::ConvertTo(f, hn::ConvertTo(w, there)), hn::Set(f, frame.last[a]));
        hn::Store(hn::Sub(there, truncated), f, batch.fraction[a] + at);
        const I cell = hn::ConvertTo(w, truncated);
        if constexpr (is_sparse) {
            const I in_block = hn::And(cell, hn::Set(w, side - 1)), of_block = hn::ShiftRight<to_block>(cell);
            hn::Store(hn::ConvertTo(f, in_block), f, batch.in_block[a] + at);
            first = hn::Add(first, times(in_block, stride));
            block = hn::Add(block, times(of_block, frame.block_row[axis]));
            corner = hn::Add(corner, times(of_block, frame.corners[axis]));
            stride *= brick_cells<D> + 1;
        } else {
            first = hn::Add(first, times(cell, frame.stride[axis]));
        }
    }
    store_indices(first, batch.first + at);
    if constexpr (is_sparse) {
        store_indices(block, batch.block + at);
        store_indices(corner, batch.corner + at);
    }
    return hn::AllTrue(f, inside);
}

template <int D, class Number>
HWY_INLINE Corners<D> corners_of(const Batch<D>& batch, std::size_t i) {
    const BatchFloats f;
    const BatchInts w;
    Corners<D> result;
    for (std::size_t row = 0; row < Batch<D>::rows; ++row)
        if constexpr (std::is_same_v<Number, float>) {
            hn::LoadInterleaved2(f, &batch.floats[row][i].low, result.v[2 * row], result.v[2 * row + 1]);
        } else {
            const I packed_pair = hn::Load(w, reinterpret_cast<const std::int32_t*>(&batch.steps[row][i]));
            constexpr std::size_t first = std::endian::native == std::endian::little ? 0 : 1;
            result.v[2 * row + first] = hn::ConvertTo(f, hn::ShiftRight<16>(hn::ShiftLeft<16>(packed_pair)));
            result.v[2 * row + 1 - first] = hn::ConvertTo(f, hn::ShiftRight<16>(packed_pair));
        }
    return result;
}

/// The distance, and the direction if requested.
template <int D, class Out>
HWY_INLINE void interpolate(const Corners<D>& corners, const F* fraction, F unit, F scale, Out* out) {
    F found[D + 1];
    found[0] = hn::Mul(distance_at(corners, fraction), unit);
    if constexpr (!std::is_same_v<Out, float>) {
        const BatchFloats f;
        F slope[D];
        slope_at(corners, fraction, slope);
        for (int a = 0; a < D; ++a) slope[a] = hn::Mul(slope[a], scale);
        F square = hn::Mul(slope[0], slope[0]);
        for (int a = 1; a < D; ++a) square = hn::Add(square, hn::Mul(slope[a], slope[a]));
        const M has_direction = hn::Gt(square, hn::Set(f, 1e-6f));
        const F one = hn::Set(f, 1.0f);
        const F inverse = hn::Div(one, hn::Sqrt(hn::IfThenElse(has_direction, square, one)));
        for (int a = 0; a < D; ++a) {
            const F fallback = a == 0 ? one : hn::Zero(f);
            found[a + 1] = hn::IfThenElse(has_direction, hn::Mul(slope[a], inverse), fallback);
        }
    }
    store(found, out);
}

/// `count` is a multiple of the lanes.
template <int D>
HWY_NOINLINE bool locate_all(const FieldData<D>& data, const Vec<D>* points, std::size_t count, Batch<D>& batch) {
    const std::size_t lanes = hn::Lanes(BatchFloats());
    bool result = true;
    if (data.store == FieldStore::sparse)
        for (std::size_t i = 0; i < count; i += lanes) result &= locate<D, true>(data.frame, points, i, batch);
    else
        for (std::size_t i = 0; i < count; i += lanes) result &= locate<D, false>(data.frame, points, i, batch);
    return result;
}

template <int D, class Number, class Out>
HWY_NOINLINE void interpolate_all(const FieldData<D>& data, std::size_t count, bool any_coarse, const Batch<D>& batch,
                                  Out* out) {
    const BatchFloats f;
    const std::size_t lanes = hn::Lanes(f);
    const float unit = std::is_same_v<Number, float> ? 1.0f : data.step, scale = unit * data.frame.inverse;
    for (std::size_t i = 0; i < count; i += lanes) {
        F fraction[D];
        for (std::size_t a = 0; a < D; ++a) fraction[a] = hn::Load(f, batch.fraction[a] + i);
        Corners<D> corners = corners_of<D, Number>(batch, i);
        F units = hn::Set(f, unit), scales = hn::Set(f, scale);
        if (any_coarse) {
            if constexpr (!std::is_same_v<Number, float>) {
                const Corners<D> coarse = corners_of<D, float>(batch, i);
                const M is_coarse = hn::Gt(hn::Load(f, batch.coarse + i), hn::Zero(f));
                for (std::size_t c = 0; c < std::size_t{1} << D; ++c)
                    corners.v[c] = hn::IfThenElse(is_coarse, coarse.v[c], corners.v[c]);
            }
            units = hn::Load(f, batch.unit + i);
            scales = hn::Load(f, batch.scale + i);
        }
        interpolate<D>(corners, fraction, units, scales, out + i);
    }
}

template <int D, class Number, class Out>
void look_up_batch(const FieldData<D>& data, const Vec<D>* points, std::size_t count, Out* out) {
    Batch<D> batch;
    const bool all_inside = locate_all<D>(data, points, count, batch);
    const bool any_coarse = fetch_all<D, Number>(data, count, batch);
    interpolate_all<D, Number>(data, count, any_coarse, batch, out);
    if (all_inside) return;
    const Aabb<D> volume = volume_of(data);
    for (std::size_t i = 0; i < count; ++i)
        if (!contains(volume, points[i])) look_up(data, points[i], out[i]);
}

template <int D, class Number, class Out>
void look_up(const FieldData<D>& data, const Vec<D>* points, std::size_t count, Out* out) {
    const std::size_t lanes = hn::Lanes(BatchFloats());
    for (; count >= batch_size; points += batch_size, out += batch_size, count -= batch_size)
        look_up_batch<D, Number>(data, points, batch_size, out);
    if (count == 0) return;
    // The remaining points, padded with the origin to full lanes.
    Vec<D> rest[batch_size];
    Out found[batch_size];
    const std::size_t filled = (count + lanes - 1) / lanes * lanes;
    std::copy(points, points + count, rest);
    std::fill(rest + count, rest + filled, data.origin);
    look_up_batch<D, Number>(data, rest, filled, found);
    std::copy(found, found + count, out);
}

template <int D, class Out>
void look_up_all(const FieldData<D>& data, const Vec<D>* points, std::size_t count, Out* out) {
    if (data.lookup == FieldLookup::gradient) {
        for (std::size_t i = 0; i < count; ++i) look_up(data, points[i], out[i]);
        return;
    }
    if (data.steps.empty())
        look_up<D, float>(data, points, count, out);
    else
        look_up<D, std::int16_t>(data, points, count, out);
}

void distances2(const FieldData<2>& data, const Vec2* points, std::size_t count, float* out) {
    look_up_all<2>(data, points, count, out);
}
void distances3(const FieldData<3>& data, const Vec3* points, std::size_t count, float* out) {
    look_up_all<3>(data, points, count, out);
}
void samples2(const FieldData<2>& data, const Vec2* points, std::size_t count, FieldSample<2>* out) {
    look_up_all<2>(data, points, count, out);
}
void samples3(const FieldData<3>& data, const Vec3* points, std::size_t count, FieldSample<3>* out) {
    look_up_all<3>(data, points, count, out);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(distances2);
HWY_EXPORT(distances3);
HWY_EXPORT(samples2);
HWY_EXPORT(samples3);

void look_up_all(const FieldData<2>& data, std::span<const Vec2> points, std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(distances2)(data, points.data(), points.size(), out.data());
}
void look_up_all(const FieldData<3>& data, std::span<const Vec3> points, std::span<float> out) {
    HWY_DYNAMIC_DISPATCH(distances3)(data, points.data(), points.size(), out.data());
}
void look_up_all(const FieldData<2>& data, std::span<const Vec2> points, std::span<FieldSample<2>> out) {
    HWY_DYNAMIC_DISPATCH(samples2)(data, points.data(), points.size(), out.data());
}
void look_up_all(const FieldData<3>& data, std::span<const Vec3> points, std::span<FieldSample<3>> out) {
    HWY_DYNAMIC_DISPATCH(samples3)(data, points.data(), points.size(), out.data());
}

}  // namespace abut::detail
#endif
