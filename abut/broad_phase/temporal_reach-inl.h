#pragma once

// What a bounded speed says about boxes: how far one has gone, and how soon two may meet or part. For .cpp files.
//
// Between two moments t apart, a face at x moves by no more than v t, give or take what rounding x to a float may do:
//   |x' - x| <= v t (1 + leeway) + 2^-22 min(|x|, |x'|)
// The arithmetic is in float: what it loses is a tenth of the leeway, and less than twice the rounding.

#include <abut/broad_phase/detail/float4-inl.h>
#include <abut/math/aabb.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace abut {

inline constexpr float leeway = 1e-6f;
inline constexpr float rounding = 0x1p-22f;  ///< two ulp at least

/// A box in the lanes of two vectors; behind those of its axes lies anything.
template <int D>
struct BoxLanes {
    static constexpr std::uint32_t axes = (1u << D) - 1;  ///< the bits of their lanes

    float4::Floats min, max;

    explicit BoxLanes(const Aabb<D>& box) {
        // One float of the other corner comes with each, in 2D two.
        static_assert(sizeof(box) == 2 * D * sizeof(float));
        const float* floats = &box.min[0];
        min = float4::load(floats);
        if constexpr (D == 2)
            max = float4::from_third(min);
        else
            max = float4::from_second(float4::load(floats + 2));
    }
};

/// Whether a box may have come from another by moving each face by at most `way`. A face at infinity stays there.
template <int D>
bool within_way(const BoxLanes<D>& before, const BoxLanes<D>& after, float way) {
    using float4::magnitude;
    const float4::Floats limit = float4::broadcast(way * (1 + leeway));
    // Between two faces at infinity there is no number, which is not greater than any.
    const auto strays = [&](float4::Floats from, float4::Floats to) {
        return magnitude(to - from) > limit + rounding * float4::min(magnitude(from), magnitude(to));
    };
    return (float4::bits(strays(before.min, after.min) | strays(before.max, after.max)) & before.axes) == 0;
}

/// Whether two boxes touch, and a way that their faces must go together, at the least, before that changes.
struct Reach {
    bool touching = false;
    float way = 0;
};

/// On each axis a face of one stands against a face of the other with a gap of x - y between them, below zero where
/// they overlap. Those that touch part as soon as one gap opens; those that don't meet when all are closed. Never
/// touching where a box is empty or has a NaN.
template <int D>
Reach reach_of(const BoxLanes<D>& a, const BoxLanes<D>& b) {
    using float4::magnitude;
    constexpr std::uint32_t axes = BoxLanes<D>::axes;
    constexpr float endless = std::numeric_limits<float>::infinity();
    if ((float4::bits((a.min <= a.max) & (b.min <= b.max)) & axes) != axes) return {};

    const float4::Floats gap = a.min - b.max, other_gap = b.min - a.max;
    const bool touching = (float4::bits((gap > 0.0f) | (other_gap > 0.0f)) & axes) == 0;
    // Each gap somewhat nearer to where it changes; the widest is the last to close, and the first to open. Between
    // faces at infinity there is no number, and nothing ever changes: the first of `greater` is left out then.
    const float nearer = touching ? 2 * rounding : -2 * rounding;
    float4::Floats widest =
        float4::max(gap + nearer * (magnitude(a.min) + magnitude(b.max)), float4::broadcast(-endless));
    widest = float4::max(other_gap + nearer * (magnitude(b.min) + magnitude(a.max)), widest);
    widest[3] = -endless;
    if constexpr (D == 2) widest[2] = -endless;
    const float way = float4::max_lane(widest);
    return {touching, std::max(touching ? -way : way, 0.0f) * (1 - 4 * leeway)};
}

/// Holds the box for as long as no face has moved by more than `way`.
template <int D>
Aabb<D> grown_by_way(const Aabb<D>& box, float way) {
    // A face at infinity stays there.
    const auto slack = [way](float x) {
        return std::isinf(x) ? 0 : way * (1 + 4 * leeway) + 2 * rounding * std::abs(x);
    };
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = box.min[i] - slack(box.min[i]);
        result.max[i] = box.max[i] + slack(box.max[i]);
    }
    return result;
}

/// How long they take for a way, at the least.
inline double time_for(float way, float speed) {
    return speed > 0 ? static_cast<double>(way / speed) : std::numeric_limits<double>::infinity();
}

/// As a float that isn't later. Endless time becomes the longest there is.
inline float no_later(double time) {
    return static_cast<float>(std::min(time, static_cast<double>(std::numeric_limits<float>::max())) * (1 - 0x1p-23));
}

/// As a float that isn't earlier, nor infinite.
inline float no_earlier(double time) {
    return static_cast<float>(std::min(time * (1 + 0x1p-23), static_cast<double>(std::numeric_limits<float>::max())));
}

}  // namespace abut
