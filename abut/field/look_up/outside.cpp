// Evaluates a field outside its volume.

#include <abut/field/look_up/stencil.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>

#include <limits>

namespace abut::detail {
namespace {

/// A lower bound of the distance from a point of the volume to the surface: each sample is the center of a ball free of
/// it.
template <int D>
double free_around(const FieldData<D>& data, const DVec<D>& point, const FieldStencil<D>& stencil) {
    const auto values = corner_values(data, stencil);
    const double unit = static_cast<double>(unit_of(data, stencil));
    const double rounding = stencil.coarse || data.steps.empty() ? 0.0 : 0.5 * unit;
    const std::uint32_t side = stencil.coarse ? brick_cells<D> : 1;
    double result = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        DVec<D> corner;
        for (int a = 0; a < D; ++a)
            corner[a] = static_cast<double>(data.origin[a]) +
                        static_cast<double>(data.cell) * static_cast<double>(stencil.low[a] + (i >> a & 1 ? side : 0));
        const double free = std::abs(static_cast<double>(values[i])) * unit - rounding;
        result = std::max(result, free - length(point - corner));
    }
    return result;
}

template <int D>
bool has_no_point(const Aabb<D>& box) {
    for (int a = 0; a < D; ++a)
        if (!(box.min[a] <= box.max[a])) return true;
    return false;
}

}  // namespace

template <int D>
FieldSample<D> outer_sample(const FieldData<D>& data, const Vec<D>& point) {
    ABUT_ASSERT(is_finite<D>(point));
    FieldSample<D> result;
    result.normal[0] = 1;
    if (!is_finite<D>(point)) return result;

    Vec<D> nearest = point;
    const Aabb<D> volume = volume_of(data);
    for (int a = 0; a < D; ++a) nearest[a] = std::clamp(nearest[a], volume.min[a], volume.max[a]);
    const DVec<D> from(nearest);
    const DVec<D> away = DVec<D>(point) - from;
    const FieldStencil<D> stencil = stencil_of(data, nearest);
    const FieldSample<D> there = linear_sample(data, nearest);
    const double depth = static_cast<double>(there.distance);
    // If the known surface is in the volume, the exterior is solid; otherwise the volume cuts the solid, which ends
    // there.
    const bool solid_outside = depth < 0 && contains(volume, data.surface);
    const double free = depth < 0 && !solid_outside ? 0 : free_around(data, from, stencil);

    // The surface in the volume lies behind the plane through `nearest` at right angles to the offset, so the angle at
    // `nearest` isn't acute, and Pythagoras gives a lower bound.
    double bound = square_root(length_squared(away) + free * free);
    // The bounding box of the surface gives another lower bound.
    if (!has_no_point(data.surface)) {
        DVec<D> to_box;
        for (int a = 0; a < D; ++a) {
            const double p = static_cast<double>(point[a]);
            to_box[a] =
                p - std::clamp(p, static_cast<double>(data.surface.min[a]), static_cast<double>(data.surface.max[a]));
        }
        bound = std::max(bound, length(to_box));
    }
    // Rounded down by more than the rounding of the samples.
    constexpr double max_float = std::numeric_limits<float>::max();
    result.distance = static_cast<float>(std::min(bound * (1 - 0x1p-22), max_float));
    // The direction from the estimated position of the surface.
    const DVec<D> guess = away + DVec<D>(there.normal) * (solid_outside ? -depth : std::max(depth, 0.0));
    result.normal = to_float<D>(normalized(guess));
    if (solid_outside) {
        result.distance = -result.distance;
        result.normal = -result.normal;
    }
    return result;
}

template FieldSample<2> outer_sample(const FieldData<2>&, const Vec2&);
template FieldSample<3> outer_sample(const FieldData<3>&, const Vec3&);

}  // namespace abut::detail
