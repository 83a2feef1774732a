#pragma once

// The tolerances of sweeps. For .cpp files.

#include <abut/convex/tolerance.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>

namespace abut::detail {

/// The part of the tolerance that the reported impact may use up, and the depth up to which parts slide.
inline constexpr double touch_fraction = 1.0 / 16, slide_fraction = 0.45;

/// How far ahead a sweep distinguishes sliding from penetrating, as a fraction of the smaller part's size.
inline constexpr double stride_fraction = 0.05;

/// A depth of at least this times the sliding depth certainly penetrates.
inline constexpr double beyond_sliding = 1.1;

/// The numbers of one part that the tolerances depend on.
struct PartExtent {
    double size;           ///< about the bounding radius
    double support_error;  ///< by how much the support function may fall short
};

/// The tolerances of a pair at its impact.
struct SweepTolerances {
    double total = 0, touch = 0, slide = 0, stride = 0;

    SweepTolerances() = default;
    SweepTolerances(const PartExtent& a, const PartExtent& b, double length) {
        const double smaller = std::min(a.size, b.size);
        const double larger = std::isfinite(a.size) && std::isfinite(b.size) ? std::max(a.size, b.size) : smaller;
        // At the contact some coordinate is nearly half as large as the size. (16 ulp of that are 9e-7 of it.)
        constexpr double all_but_half = 4.5e-7 / sixteen_ulp;
        total = tolerance_for(smaller, all_but_half * larger);
        touch = touch_fraction * total + a.support_error + b.support_error + 1e-15 * length;
        slide = slide_fraction * total + 2e-15 * length;
        stride = std::max(stride_fraction * smaller, 16 * (slide + touch));
    }
};

}  // namespace abut::detail
