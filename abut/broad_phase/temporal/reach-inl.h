#pragma once

// Bounds for boxes of limited speed: how far one has moved, and how soon two may begin or cease to overlap. For .cpp
// files.
//
// Between two moments t apart, a face at x moves by at most v t, with a tolerance for rounding x to a float:
//   |x' - x| <= v t (1 + leeway) + 2^-22 min(|x|, |x'|)
// The arithmetic is in float. Its error is a tenth of the leeway, and less than twice the rounding.

#include <abut/math/aabb.hpp>
#include <abut/math/simd/float4-inl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace abut::detail {

inline constexpr float leeway = 1e-6f;
inline constexpr float rounding = 0x1p-22f;  ///< two ulp at least

/// A box in the lanes of two vectors. The lanes beyond its axes are undefined.
template <int D>
struct BoxLanes {
    static constexpr std::uint32_t axes = (1u << D) - 1;  ///< the bits of their lanes

    float4::Floats min, max;

    explicit BoxLanes(const Aabb<D>& box) {
        // One float of the other corner comes with each, in 2D two.
        static_assert(sizeof(box) == 2 * D * sizeof(float));
        min = float4::load(&box.min[0]);
        const float4::Floats last_four = float4::load(&box.min[0] + 2 * D - 4);
        max = D == 2 ? float4::from_third(last_four) : float4::from_second(last_four);
    }
};

/// True if each face of a box has moved by at most `travel`. A face at infinity stays there.
template <int D>
bool within_travel(const BoxLanes<D>& before, const BoxLanes<D>& after, float travel) {
    using float4::magnitude;
    const float4::Floats limit = float4::broadcast(travel * (1 + leeway));
    // Between two faces at infinity there is no number, which is not greater than any.
    const auto strays = [&](float4::Floats from, float4::Floats to) {
        return magnitude(to - from) > limit + rounding * float4::min(magnitude(from), magnitude(to));
    };
    return (float4::bits(strays(before.min, after.min) | strays(before.max, after.max)) & before.axes) == 0;
}

/// Whether two boxes overlap, and a lower bound of how far their faces travel together before that changes.
struct Reach {
    bool touching = false;
    float travel = 0;
};

/// Each axis has two gaps between opposite faces, below zero where the boxes overlap. Boxes that touch separate as soon
/// as one gap opens; others touch once all gaps are closed. The widest gap is the last to close, and the first to open.
/// Empty boxes and boxes with a NaN never touch.
template <int D>
Reach reach_of(const BoxLanes<D>& a, const BoxLanes<D>& b) {
    using float4::magnitude;
    constexpr std::uint32_t axes = BoxLanes<D>::axes;
    if ((float4::bits((a.min <= a.max) & (b.min <= b.max)) & axes) != axes) return {};

    const float4::Floats gap = a.min - b.max, other_gap = b.min - a.max;
    const float4::Floats tolerance = 2 * rounding * (magnitude(a.min) + magnitude(b.max)),
                         other_tolerance = 2 * rounding * (magnitude(b.min) + magnitude(a.max));
    // The gap between faces at infinity is NaN and never changes: `max` ignores a first operand that is NaN.
    const float4::Floats none = float4::broadcast(-std::numeric_limits<float>::infinity());
    const auto widest = [none](float4::Floats first, float4::Floats second) {
        float4::Floats result = float4::max(second, float4::max(first, none));
        for (int i = D; i < 4; ++i) result[i] = none[i];
        return float4::max_lane(result);
    };
    const float closes = widest(gap - tolerance, other_gap - other_tolerance),
                opens = -widest(gap + tolerance, other_gap + other_tolerance);
    return {(float4::bits((gap > 0.0f) | (other_gap > 0.0f)) & axes) == 0,
            std::max({closes, opens, 0.0f}) * (1 - 4 * leeway)};
}

/// Contains the box as long as no face has moved by more than `travel`.
template <int D>
Aabb<D> grown_by_travel(const Aabb<D>& box, float travel) {
    // A face at infinity stays there.
    const auto margin = [travel](float x) {
        return std::isinf(x) ? 0 : travel * (1 + 4 * leeway) + 2 * rounding * std::abs(x);
    };
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = box.min[i] - margin(box.min[i]);
        result.max[i] = box.max[i] + margin(box.max[i]);
    }
    return result;
}

/// Rounded down to a float; infinite time becomes the largest float.
inline float no_later(double time) {
    return static_cast<float>(std::min(time, static_cast<double>(std::numeric_limits<float>::max())) * (1 - 0x1p-23));
}

/// Rounded up to a float, at most the largest finite one.
inline float no_earlier(double time) {
    return static_cast<float>(std::min(time * (1 + 0x1p-23), static_cast<double>(std::numeric_limits<float>::max())));
}

}  // namespace abut::detail
