#pragma once

// What of two parts that come to touch may be rounding. For .cpp files.

#include <abut/convex/tolerance.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>

namespace abut {

/// What part of the margin of doubt may be lost where they are said to touch, and how deep in what slides may be.
inline constexpr double touch_part = 1.0 / 16, slide_part = 0.45;

/// How far ahead is looked to tell sliding from going in, in parts of the size of the smaller part.
inline constexpr double stride_part = 0.05;

/// What is at least so much of the depth of what may slide goes in, or passes, for sure.
inline constexpr double beyond_sliding = 1.1;

/// What a part brings to the doubts about a pair.
struct Reach {
    double size;   ///< about its bounding radius
    double noise;  ///< by how much its support may be short of the farthest
};

/// Of a pair as it is where the two touch.
struct Doubts {
    double margin = 0, touch = 0, slide = 0, stride = 0;

    Doubts() = default;
    Doubts(const Reach& a, const Reach& b, double length) {
        const double smaller = std::min(a.size, b.size);
        const double larger = std::isfinite(a.size) && std::isfinite(b.size) ? std::max(a.size, b.size) : smaller;
        // Where they touch, some coordinate is all but half as large as the size. (9e-7 of that is 16 ulp.)
        constexpr double all_but_half = 4.5e-7 / sixteen_ulp;
        margin = tolerance_for(smaller, all_but_half * larger);
        touch = touch_part * margin + a.noise + b.noise + 1e-15 * length;
        slide = slide_part * margin + 2e-15 * length;
        stride = std::max(stride_part * smaller, 16 * (slide + touch));
    }
};

}  // namespace abut
