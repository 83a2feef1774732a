// Highway compiles this file once for each SIMD target. Products, sums and quotients are rounded one by one in all of
// them, and a maximum doesn't depend on the order of the comparisons.

#include <abut/convex/ray/planes.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/convex/ray/planes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using Vector = hn::Vec<Doubles>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Highway's emulated target returns the largest finite number in place of infinity.
double unbounded(double value) {
    constexpr double max_finite = std::numeric_limits<double>::max();
    return value >= max_finite ? infinity : value <= -max_finite ? -infinity : value;
}

/// Clips with one plane.
void cut(const DVec<3>& normal, double offset, const DVec<3>& origin, const DVec<3>& direction, std::size_t index,
         PlaneCut& result) {
    const double height = dot(normal, origin) - offset, descent = -dot(normal, direction);
    const double along = height / descent;
    if (descent > 0 && along > result.cut.lower) {
        result.cut.lower = along;
        result.in = index;
    }
    if (descent < 0 && along < result.cut.upper) {
        result.cut.upper = along;
        result.out = index;
    }
    if (descent == 0) result.beside = std::max(result.beside, height);
}

/// The first plane with this value.
std::size_t plane_of(Vector values, Vector planes, double value, std::size_t count) {
    const Doubles d;
    const Vector none = hn::Set(d, static_cast<double>(count));
    return static_cast<std::size_t>(
        hn::GetLane(hn::MinOfLanes(d, hn::IfThenElse(hn::Eq(values, hn::Set(d, value)), planes, none))));
}

PlaneCut cut_many(const Vec3* normals, const double* offsets, std::size_t count, double out, const DVec<3>& origin,
                  const DVec<3>& direction) {
    const Doubles d;
    const std::size_t lanes = hn::Lanes(d);
    const Vector ox = hn::Set(d, origin.x), oy = hn::Set(d, origin.y), oz = hn::Set(d, origin.z);
    const Vector dx = hn::Set(d, direction.x), dy = hn::Set(d, direction.y), dz = hn::Set(d, direction.z);
    const Vector farther = hn::Set(d, out), zero = hn::Zero(d);
    const Vector none = hn::Set(d, static_cast<double>(count));
    PlaneCut result;
    result.in = result.out = count;
    if (count < lanes) {
        for (std::size_t i = 0; i < count; ++i)
            cut(DVec<3>(normals[i]), offsets[i] + out, origin, direction, i, result);
    } else {
        Vector lower = hn::Set(d, -infinity), upper = hn::Set(d, infinity), beside = lower, in = none, exit = none;
        // The last block starts early enough to be full: clipping with a plane twice changes nothing.
        for (std::size_t next = 0; next < count; next += lanes) {
            const std::size_t i = std::min(next, count - lanes);
            const Vector index = hn::Iota(d, static_cast<double>(i));
            hn::Vec<Floats> fx, fy, fz;
            hn::LoadInterleaved3(Floats(), &normals[i].x, fx, fy, fz);
            const Vector x = hn::PromoteTo(d, fx), y = hn::PromoteTo(d, fy), z = hn::PromoteTo(d, fz);
            const Vector reach = hn::Add(hn::Add(hn::Mul(x, ox), hn::Mul(y, oy)), hn::Mul(z, oz));
            const Vector rises = hn::Add(hn::Add(hn::Mul(x, dx), hn::Mul(y, dy)), hn::Mul(z, dz));
            const Vector height = hn::Sub(reach, hn::Add(hn::LoadU(d, offsets + i), farther));
            const Vector descent = hn::Sub(zero, rises), along = hn::Div(height, descent);
            const auto enters = hn::And(hn::Gt(descent, zero), hn::Gt(along, lower));
            lower = hn::IfThenElse(enters, along, lower);
            in = hn::IfThenElse(enters, index, in);
            const auto leaves = hn::And(hn::Lt(descent, zero), hn::Lt(along, upper));
            upper = hn::IfThenElse(leaves, along, upper);
            exit = hn::IfThenElse(leaves, index, exit);
            beside = hn::IfThenElse(hn::And(hn::Eq(descent, zero), hn::Gt(height, beside)), height, beside);
        }
        result.cut.lower = unbounded(hn::GetLane(hn::MaxOfLanes(d, lower)));
        result.cut.upper = unbounded(hn::GetLane(hn::MinOfLanes(d, upper)));
        result.beside = unbounded(hn::GetLane(hn::MaxOfLanes(d, beside)));
        result.in = plane_of(lower, in, result.cut.lower, count);
        result.out = plane_of(upper, exit, result.cut.upper, count);
    }
    const auto slope = [&](std::size_t plane) {
        return plane < count ? std::abs(dot(DVec<3>(normals[plane]), direction)) : 0;
    };
    result.cut.slope_in = slope(result.in);
    result.cut.slope_out = slope(result.out);
    return result;
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(cut_many);

PlaneCut cut_by_planes(std::span<const Vec3> normals, std::span<const double> offsets, double out,
                       const DVec<3>& origin, const DVec<3>& direction) {
    return HWY_DYNAMIC_DISPATCH(cut_many)(normals.data(), offsets.data(), normals.size(), out, origin, direction);
}

}  // namespace abut::detail
#endif
