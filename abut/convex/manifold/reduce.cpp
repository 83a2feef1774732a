// Evaluates several opposite points at once in SIMD. Highway compiles this file once for each target; lanes are
// independent, and rounding is the same on all targets.

#include <abut/convex/manifold/reduce.hpp>

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/manifold/reduce.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Twice the areas on both sides of the diagonals from the origin to each point. `count` is a multiple of 8.
void areas_about_diagonals(const double* x, const double* y, std::size_t used, std::size_t count, double* areas) {
    const hn::CappedTag<double, 8> d;
    const auto zero = hn::Zero(d);
    for (std::size_t opposite = 0; opposite < count; opposite += hn::Lanes(d)) {
        const auto along_x = hn::LoadU(d, x + opposite), along_y = hn::LoadU(d, y + opposite);
        auto left = zero, right = zero;
        for (std::size_t i = 0; i < used; ++i) {
            const auto off = hn::Sub(hn::Mul(along_x, hn::Set(d, y[i])), hn::Mul(along_y, hn::Set(d, x[i])));
            left = hn::IfThenElse(hn::Gt(off, left), off, left);
            right = hn::IfThenElse(hn::Lt(off, right), off, right);
        }
        hn::StoreU(hn::Sub(left, right), d, areas + opposite);
    }
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(areas_about_diagonals);

std::array<std::size_t, 4> largest_quadrilateral(std::span<const double> x, std::span<const double> y,
                                                 std::size_t first) {
    // Relative to the first point, which also pads the rows.
    constexpr std::size_t capacity = 72;
    const std::size_t used = x.size() < capacity ? x.size() : capacity, count = (used + 7) / 8 * 8;
    std::array<double, capacity> to_x, to_y, areas;
    for (std::size_t i = 0; i < count; ++i) {
        to_x[i] = i < used ? x[i] - x[first] : 0;
        to_y[i] = i < used ? y[i] - y[first] : 0;
    }
    HWY_DYNAMIC_DISPATCH(areas_about_diagonals)(to_x.data(), to_y.data(), used, count, areas.data());

    std::size_t best = first;
    double largest = 0;
    for (std::size_t i = 0; i < used; ++i) {
        const double size = areas[i] > 0 ? areas[i] : 1e-12 * (std::abs(to_x[i]) + std::abs(to_y[i]));
        best = size > largest ? i : best;
        largest = size > largest ? size : largest;
    }
    std::size_t left = first, right = first;
    double off_left = 0, off_right = 0;
    for (std::size_t i = 0; i < used; ++i) {
        const double off = to_x[best] * to_y[i] - to_y[best] * to_x[i];
        left = off > off_left ? i : left;
        off_left = off > off_left ? off : off_left;
        right = off < off_right ? i : right;
        off_right = off < off_right ? off : off_right;
    }
    return {first, best, left, right};
}

}  // namespace abut::detail
#endif
