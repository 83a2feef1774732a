// Highway compiles this file once for each SIMD target and selects the best at run time. Products and sums are rounded
// one by one in all of them, and a maximum doesn't depend on the order of the comparisons.

#include <abut/convex/farthest_point.hpp>
#include <abut/math/simd/dispatch-inl.h>

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/farthest_point.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After Highway's headers, because it is included once for each target.
#include <abut/convex/farthest_simd-inl.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using FewFloats = hn::Rebind<float, Doubles>;
using Vector = hn::Vec<Doubles>;

Vector along(const Vec2* points, const Vector* direction) {
    hn::Vec<FewFloats> x, y;
    hn::LoadInterleaved2(FewFloats(), &points->x, x, y);
    const Doubles d;
    return hn::Add(hn::Mul(hn::PromoteTo(d, x), direction[0]), hn::Mul(hn::PromoteTo(d, y), direction[1]));
}

Vector along(const Vec3* points, const Vector* direction) {
    hn::Vec<FewFloats> x, y, z;
    hn::LoadInterleaved3(FewFloats(), &points->x, x, y, z);
    const Doubles d;
    const Vector xy = hn::Add(hn::Mul(hn::PromoteTo(d, x), direction[0]), hn::Mul(hn::PromoteTo(d, y), direction[1]));
    return hn::Add(xy, hn::Mul(hn::PromoteTo(d, z), direction[2]));
}

/// Each lane holds the first of its maxima. The lanes are compared at the end, and then the remainder.
template <int D>
std::uint32_t farthest(const Vec<D>* points, std::size_t count, const DVec<D>& direction) {
    const Doubles d;
    const std::size_t lanes = hn::Lanes(d);
    Vector axes[D];
    for (int i = 0; i < D; ++i) axes[i] = hn::Set(d, direction[i]);

    constexpr double lowest = -std::numeric_limits<double>::infinity();
    Vector maximum = hn::Set(d, lowest), best = hn::Zero(d), index = hn::Iota(d, 0.0);
    const Vector step = hn::Set(d, static_cast<double>(lanes));
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const Vector here = along(points + i, axes);
        const auto farther = hn::Gt(here, maximum);
        maximum = hn::IfThenElse(farther, here, maximum);
        best = hn::IfThenElse(farther, index, best);
        index = hn::Add(index, step);
    }

    HWY_ALIGN double lane_max[hn::MaxLanes(d)];
    HWY_ALIGN double lane_best[hn::MaxLanes(d)];
    hn::Store(maximum, d, lane_max);
    hn::Store(best, d, lane_best);
    double result = lane_best[0], value = lane_max[0];
    for (std::size_t lane = 1; lane < lanes; ++lane)
        if (lane_max[lane] > value || (lane_max[lane] == value && lane_best[lane] < result)) {
            value = lane_max[lane];
            result = lane_best[lane];
        }
    for (; i < count; ++i) {
        double here = static_cast<double>(points[i][0]) * direction[0];
        for (int axis = 1; axis < D; ++axis) here += static_cast<double>(points[i][axis]) * direction[axis];
        if (here > value) {
            value = here;
            result = static_cast<double>(i);
        }
    }
    return static_cast<std::uint32_t>(result);
}

ABUT_NAME_DIMENSIONS(farthest);

std::uint32_t farthest_of_lanes(const PointSoa& points, const DVec<3>& direction) {
    return farthest_lane(points, direction);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(farthest);
HWY_EXPORT(farthest_of_lanes);

std::uint32_t farthest_point(std::span<const Vec2> points, const DVec<2>& direction) {
    return dispatched_farthest<2>()(points.data(), points.size(), direction);
}
std::uint32_t farthest_point(std::span<const Vec3> points, const DVec<3>& direction) {
    return dispatched_farthest<3>()(points.data(), points.size(), direction);
}
std::uint32_t farthest_point(const PointSoa& points, const DVec<3>& direction) {
    return HWY_DYNAMIC_DISPATCH(farthest_of_lanes)(points, direction);
}

}  // namespace abut::detail
#endif
