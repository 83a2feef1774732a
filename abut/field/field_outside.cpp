// What a field tells of points outside of its volume.

#include <abut/field/field_spot.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>

#include <limits>

namespace abut {
namespace {

/// No surface is nearer to a point of the volume: each sample keeps a ball free.
template <int D>
double free_around(const FieldData<D>& data, const DVec<D>& point, const FieldSpot<D>& spot) {
    const auto values = corner_values(data, spot);
    const double unit = static_cast<double>(unit_of(data, spot));
    const double doubt = spot.coarse || data.steps.empty() ? 0.0 : 0.5 * unit;
    const std::uint32_t side = spot.coarse ? brick_cells<D> : 1;
    double result = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        DVec<D> corner;
        for (int a = 0; a < D; ++a)
            corner[a] = static_cast<double>(data.origin[a]) +
                        static_cast<double>(data.cell) * static_cast<double>(spot.low[a] + (i >> a & 1 ? side : 0));
        const double free = std::abs(static_cast<double>(values[i])) * unit - doubt;
        result = std::max(result, free - length(point - corner));
    }
    return result;
}

template <int D>
bool is_empty(const Aabb<D>& box) {
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

    Vec<D> near = point;
    const Aabb<D> volume = volume_of(data);
    for (int a = 0; a < D; ++a) near[a] = std::clamp(near[a], volume.min[a], volume.max[a]);
    const DVec<D> from(near);
    const DVec<D> away = DVec<D>(point) - from;
    const FieldSpot<D> spot = spot_of(data, near);
    const FieldSample<D> there = linear_sample(data, near);
    const double depth = static_cast<double>(there.distance);
    // Solid as far as is known; else the volume cuts the solid, which ends with it.
    const bool solid_outside = depth < 0 && contains(volume, data.surface);
    const double free = depth < 0 && !solid_outside ? 0 : free_around(data, from, spot);

    // All of the surface that is in the volume lies behind the plane through `near` at right angles to the way there:
    // the angle at `near` is no acute one.
    double least = std::sqrt(length_squared(away) + free * free);
    // Nor is it nearer than the box around it.
    if (!is_empty(data.surface)) {
        DVec<D> to_box;
        for (int a = 0; a < D; ++a) {
            const double p = static_cast<double>(point[a]);
            to_box[a] =
                p - std::clamp(p, static_cast<double>(data.surface.min[a]), static_cast<double>(data.surface.max[a]));
        }
        least = std::max(least, length(to_box));
    }
    // Rounded down, and a little more: the samples are rounded too.
    constexpr double max_float = std::numeric_limits<float>::max();
    result.distance = static_cast<float>(std::min(least * (1 - 0x1p-22), max_float));
    // From where the surface about is.
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

}  // namespace abut
