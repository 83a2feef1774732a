// Many look-ups at once. Compiled once for each kind of vector unit by Highway, which takes the best of them when the
// program runs. A lane does what `linear_sample` does, operation by operation; points that aren't in the volume are
// looked up one by one.

#include <abut/field/field_batch.hpp>
#include <abut/field/field_look_up.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/field/field_batch.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After them: once for each target.

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using BatchFloats = hn::CappedTag<float, 16>;
using BatchWhole = hn::RebindToSigned<BatchFloats>;
using F = hn::Vec<BatchFloats>;
using I = hn::Vec<BatchWhole>;
using M = hn::Mask<BatchFloats>;

/// As many points are looked up at a time: first where they lie, by vectors; then what lies there is fetched, one by
/// one, which no gathering by vectors beats; then what it tells, by vectors.
constexpr std::size_t at_a_time = 64;

/// Two neighbours along the first axis.
struct FloatPair {
    float low, high;
};
struct StepPair {
    std::int16_t low, high;
};

/// What is known of so many points.
template <int D>
struct Batch {
    static constexpr std::size_t rows = std::size_t{1} << (D - 1);

    alignas(64) float share[D][at_a_time];
    alignas(64) std::uint32_t first[at_a_time];   ///< dense: the first sample; sparse: the one in the brick
    alignas(64) std::uint32_t block[at_a_time];   ///< sparse
    alignas(64) std::uint32_t corner[at_a_time];  ///< sparse: of the block, the first corner
    alignas(64) float in_block[D][at_a_time];     ///< sparse: the cell's place in it
    alignas(64) float unit[at_a_time];            ///< what the numbers are multiples of
    alignas(64) float scale[at_a_time];           ///< the slope along an axis of a rise from corner to corner
    alignas(64) FloatPair floats[rows][at_a_time];
    alignas(64) StepPair steps[rows][at_a_time];
    bool coarse[at_a_time];
};

HWY_INLINE F lerp(F a, F b, F share) {
    return hn::Add(a, hn::Mul(share, hn::Sub(b, a)));
}

/// The distances at the corners of a cube.
template <int D>
struct Corners {
    F v[std::size_t{1} << D];
};
HWY_INLINE F distance_at(const Corners<2>& c, const F* share) {
    return lerp(lerp(c.v[0], c.v[1], share[0]), lerp(c.v[2], c.v[3], share[0]), share[1]);
}
HWY_INLINE F distance_at(const Corners<3>& c, const F* share) {
    const F low = lerp(lerp(c.v[0], c.v[1], share[0]), lerp(c.v[2], c.v[3], share[0]), share[1]);
    const F high = lerp(lerp(c.v[4], c.v[5], share[0]), lerp(c.v[6], c.v[7], share[0]), share[1]);
    return lerp(low, high, share[2]);
}
HWY_INLINE void slope_at(const Corners<2>& c, const F* share, F* slope) {
    slope[0] = lerp(hn::Sub(c.v[1], c.v[0]), hn::Sub(c.v[3], c.v[2]), share[1]);
    slope[1] = hn::Sub(lerp(c.v[2], c.v[3], share[0]), lerp(c.v[0], c.v[1], share[0]));
}
HWY_INLINE void slope_at(const Corners<3>& c, const F* share, F* slope) {
    const F p = lerp(c.v[0], c.v[1], share[0]), q = lerp(c.v[2], c.v[3], share[0]);
    const F r = lerp(c.v[4], c.v[5], share[0]), s = lerp(c.v[6], c.v[7], share[0]);
    const F low = lerp(hn::Sub(c.v[1], c.v[0]), hn::Sub(c.v[3], c.v[2]), share[1]);
    const F high = lerp(hn::Sub(c.v[5], c.v[4]), hn::Sub(c.v[7], c.v[6]), share[1]);
    slope[0] = lerp(low, high, share[2]);
    slope[1] = lerp(hn::Sub(q, p), hn::Sub(s, r), share[2]);
    slope[2] = hn::Sub(lerp(r, s, share[1]), lerp(p, q, share[1]));
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
    return hn::Mul(a, hn::Set(BatchWhole(), static_cast<std::int32_t>(b)));
}
HWY_INLINE void keep(I numbers, std::uint32_t* to) {
    hn::Store(numbers, BatchWhole(), reinterpret_cast<std::int32_t*>(to));
}

/// Where points lie. True where all are in the volume; others are taken for its lower corner.
template <int D, bool is_sparse>
HWY_INLINE bool place(const FieldFrame<D>& frame, const Vec<D>* points, std::size_t at, Batch<D>& batch) {
    constexpr auto side = static_cast<std::int32_t>(brick_cells<D>);
    constexpr int to_block = D == 2 ? 3 : 2;
    static_assert(1 << to_block == side);
    const BatchFloats f;
    const BatchWhole w;
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
        const F whole = hn::Min(hn::ConvertTo(f, hn::ConvertTo(w, there)), hn::Set(f, frame.last[a]));
        hn::Store(hn::Sub(there, whole), f, batch.share[a] + at);
        const I cell = hn::ConvertTo(w, whole);
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
    keep(first, batch.first + at);
    if constexpr (is_sparse) {
        keep(block, batch.block + at);
        keep(corner, batch.corner + at);
    }
    return hn::AllTrue(f, inside);
}

template <int D, class Pair, class Number>
HWY_INLINE void fetch(const Number* from, std::uint32_t row, std::uint32_t slice, Pair (*rows)[at_a_time],
                      std::size_t i) {
    static_assert(sizeof(Pair) == 2 * sizeof(Number));
    std::memcpy(&rows[0][i], from, sizeof(Pair));
    std::memcpy(&rows[1][i], from + row, sizeof(Pair));
    if constexpr (D == 3) {
        std::memcpy(&rows[2][i], from + slice, sizeof(Pair));
        std::memcpy(&rows[3][i], from + slice + row, sizeof(Pair));
    }
}
template <int D>
HWY_INLINE void fetch_samples(const FieldData<D>& data, std::uint32_t first, std::uint32_t row, std::uint32_t slice,
                              Batch<D>& batch, std::size_t i, float) {
    fetch<D>(data.distance.data() + first, row, slice, batch.floats, i);
}
template <int D>
HWY_INLINE void fetch_samples(const FieldData<D>& data, std::uint32_t first, std::uint32_t row, std::uint32_t slice,
                              Batch<D>& batch, std::size_t i, std::int16_t) {
    fetch<D>(data.steps.data() + first, row, slice, batch.steps, i);
}

template <int D, class Number>
HWY_INLINE Corners<D> corners_of(const Batch<D>& batch, std::size_t i) {
    const BatchFloats f;
    const BatchWhole w;
    Corners<D> result;
    for (std::size_t row = 0; row < Batch<D>::rows; ++row)
        if constexpr (std::is_same_v<Number, float>) {
            hn::LoadInterleaved2(f, &batch.floats[row][i].low, result.v[2 * row], result.v[2 * row + 1]);
        } else {
            const I both = hn::Load(w, reinterpret_cast<const std::int32_t*>(&batch.steps[row][i]));
            result.v[2 * row] = hn::ConvertTo(f, hn::ShiftRight<16>(hn::ShiftLeft<16>(both)));
            result.v[2 * row + 1] = hn::ConvertTo(f, hn::ShiftRight<16>(both));
        }
    return result;
}

/// The distance, and the direction where it is asked for.
template <int D, class Out>
HWY_INLINE void tell(const Corners<D>& corners, const F* share, F unit, F scale, Out* out) {
    F found[D + 1];
    found[0] = hn::Mul(distance_at(corners, share), unit);
    if constexpr (!std::is_same_v<Out, float>) {
        const BatchFloats f;
        F slope[D];
        slope_at(corners, share, slope);
        for (int a = 0; a < D; ++a) slope[a] = hn::Mul(slope[a], scale);
        F square = hn::Mul(slope[0], slope[0]);
        for (int a = 1; a < D; ++a) square = hn::Add(square, hn::Mul(slope[a], slope[a]));
        const M known = hn::Gt(square, hn::Set(f, 1e-6f));
        const F one = hn::Set(f, 1.0f);
        const F inverse = hn::Div(one, hn::Sqrt(hn::IfThenElse(known, square, one)));
        for (int a = 0; a < D; ++a) {
            const F otherwise = a == 0 ? one : hn::Zero(f);
            found[a + 1] = hn::IfThenElse(known, hn::Mul(slope[a], inverse), otherwise);
        }
    }
    store(found, out);
}

/// So many points, a multiple of the lanes.
template <int D, class Number, bool is_sparse, class Out>
HWY_NOINLINE void look_up_batch(const FieldData<D>& data, const Vec<D>* points, std::size_t count, Out* out) {
    const BatchFloats f;
    const std::size_t lanes = hn::Lanes(f);
    const FieldFrame<D>& frame = data.frame;
    const float unit = std::is_same_v<Number, float> ? 1.0f : data.step, scale = unit * frame.inverse;
    Batch<D> batch;
    bool all_inside = true, any_coarse = false;
    for (std::size_t i = 0; i < count; i += lanes) all_inside &= place<D, is_sparse>(frame, points, i, batch);

    constexpr std::uint32_t side = brick_cells<D>;
    if constexpr (is_sparse) {
        const glm::vec<D, std::uint32_t> corners = frame.corners;
        const std::uint32_t* bricks = data.brick.data();
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t brick = bricks[batch.block[i]];
            batch.coarse[i] = brick == no_brick;
            if (brick != no_brick) {
                const std::uint32_t first = brick * brick_samples<D> + batch.first[i];
                fetch_samples<D>(data, first, side + 1, (side + 1) * (side + 1), batch, i, Number());
                batch.unit[i] = unit;
                batch.scale[i] = scale;
            } else {
                any_coarse = true;
                const float* from = data.coarse.data() + batch.corner[i];
                fetch<D>(from, corners[1], corners[D - 1], batch.floats, i);
                batch.unit[i] = 1;
                batch.scale[i] = frame.inverse * (1.0f / side);
                for (std::size_t a = 0; a < D; ++a)
                    batch.share[a][i] = (batch.share[a][i] + batch.in_block[a][i]) * (1.0f / side);
            }
        }
    } else {
        const glm::vec<D, std::uint32_t> stride = frame.stride;
        for (std::size_t i = 0; i < count; ++i)
            fetch_samples<D>(data, batch.first[i], stride[1], stride[D - 1], batch, i, Number());
    }

    for (std::size_t i = 0; i < count; i += lanes) {
        F share[D];
        for (std::size_t a = 0; a < D; ++a) share[a] = hn::Load(f, batch.share[a] + i);
        if (is_sparse && any_coarse) {
            Corners<D> corners = corners_of<D, Number>(batch, i);
            if constexpr (!std::is_same_v<Number, float>) {
                // Which of them are floats can be told by what they are multiples of, as steps of 1 have no effect.
                const Corners<D> coarse = corners_of<D, float>(batch, i);
                HWY_ALIGN float is_coarse[hn::MaxLanes(f)];
                for (std::size_t lane = 0; lane < lanes; ++lane) is_coarse[lane] = batch.coarse[i + lane] ? 1.0f : 0.0f;
                const M take = hn::Gt(hn::Load(f, is_coarse), hn::Zero(f));
                for (std::size_t c = 0; c < std::size_t{1} << D; ++c)
                    corners.v[c] = hn::IfThenElse(take, coarse.v[c], corners.v[c]);
            }
            tell<D>(corners, share, hn::Load(f, batch.unit + i), hn::Load(f, batch.scale + i), out + i);
        } else {
            tell<D>(corners_of<D, Number>(batch, i), share, hn::Set(f, unit), hn::Set(f, scale), out + i);
        }
    }
    if (all_inside) return;
    const Aabb<D> volume = volume_of(data);
    for (std::size_t i = 0; i < count; ++i)
        if (!contains(volume, points[i])) look_up(data, points[i], out[i]);
}

template <int D, class Number, bool is_sparse, class Out>
void look_up(const FieldData<D>& data, const Vec<D>* points, std::size_t count, Out* out) {
    const std::size_t lanes = hn::Lanes(BatchFloats());
    for (; count >= at_a_time; points += at_a_time, out += at_a_time, count -= at_a_time)
        look_up_batch<D, Number, is_sparse>(data, points, at_a_time, out);
    if (count == 0) return;
    // What is left over, filled up by what is easy to look up.
    Vec<D> rest[at_a_time];
    Out told[at_a_time];
    const std::size_t filled = (count + lanes - 1) / lanes * lanes;
    std::copy(points, points + count, rest);
    std::fill(rest + count, rest + filled, data.origin);
    look_up_batch<D, Number, is_sparse>(data, rest, filled, told);
    std::copy(told, told + count, out);
}

template <int D, class Out>
void look_up_all(const FieldData<D>& data, const Vec<D>* points, std::size_t count, Out* out) {
    if (data.lookup == FieldLookup::gradient) {
        for (std::size_t i = 0; i < count; ++i) look_up(data, points[i], out[i]);
        return;
    }
    const bool sparse = data.store == FieldStore::sparse;
    if (data.steps.empty())
        sparse ? look_up<D, float, true>(data, points, count, out) : look_up<D, float, false>(data, points, count, out);
    else if (sparse)
        look_up<D, std::int16_t, true>(data, points, count, out);
    else
        look_up<D, std::int16_t, false>(data, points, count, out);
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

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

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

}  // namespace abut
#endif
