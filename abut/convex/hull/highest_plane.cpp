// Highway compiles this file once for each SIMD target and selects the best at run time. Each point has a lane of its
// own, whose products and sums are rounded one by one.

#include <abut/convex/hull/highest_plane.hpp>

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/hull/highest_plane.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void find_highest_planes(std::span<const Plane<3>> planes, const PointColumns& points, double* heights,
                         double* numbers) {
    const hn::CappedTag<double, highest_plane_padding> d;
    for (std::size_t i = 0; i < points.count; i += hn::Lanes(d)) {
        const auto x = hn::LoadU(d, points.x + i), y = hn::LoadU(d, points.y + i), z = hn::LoadU(d, points.z + i);
        auto maximum = hn::Set(d, -std::numeric_limits<double>::infinity()), best = hn::Zero(d), number = hn::Zero(d);
        for (const Plane<3>& plane : planes) {
            const auto xy = hn::Add(hn::Mul(x, hn::Set(d, plane.normal.x)), hn::Mul(y, hn::Set(d, plane.normal.y)));
            const auto along = hn::Add(xy, hn::Mul(z, hn::Set(d, plane.normal.z)));
            const auto height = hn::Sub(along, hn::Set(d, plane.offset));
            const auto higher = hn::Gt(height, maximum);
            maximum = hn::IfThenElse(higher, height, maximum);
            best = hn::IfThenElse(higher, number, best);
            number = hn::Add(number, hn::Set(d, 1.0));
        }
        hn::StoreU(maximum, d, heights + i);
        hn::StoreU(best, d, numbers + i);
    }
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(find_highest_planes);

void highest_planes(std::span<const Plane<3>> planes, const PointColumns& points, double* heights, double* numbers) {
    HWY_DYNAMIC_DISPATCH(find_highest_planes)(planes, points, heights, numbers);
}

}  // namespace abut::detail
#endif
