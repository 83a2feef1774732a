// Closest points of a field's surface.

#include <abut/field/field.hpp>
#include <abut/field/look_up/stencil.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace abut {

using namespace detail;

namespace {

/// Descends along the gradient until the surface is nearly reached. Returns the place of least distance on the path.
template <int D>
Vec<D> descend(const Field<D>& field, Vec<D> place) {
    constexpr int max_steps = 32;
    const FieldData<D>& data = field.data();
    const Aabb<D> volume = volume_of(data);
    Vec<D> best = place;
    float min_distance = std::numeric_limits<float>::infinity();
    for (int i = 0; i < max_steps; ++i) {
        const FieldSample<D> here = field.sample(place);
        if (std::abs(here.distance) < min_distance) {
            min_distance = std::abs(here.distance);
            best = place;
        }
        if (min_distance <= 1e-4f * data.cell) break;
        for (int a = 0; a < D; ++a)
            place[a] = std::clamp(place[a] - here.distance * here.normal[a], volume.min[a], volume.max[a]);
    }
    return best;
}

/// The tangent planes of the surface at the closest points of a cell's corners.
template <int D>
class Planes {
public:
    Planes(const FieldData<D>& data, const FieldStencil<D>& stencil, const Vec<D>& normal) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t sample = stencil.corner(i);
            DVec<D> corner;
            for (int a = 0; a < D; ++a)
                corner[a] = static_cast<double>(data.origin[a]) +
                            static_cast<double>(data.cell) * static_cast<double>(stencil.low[a] + (i >> a & 1));
            point_[i] = DVec<D>(data.closest[sample]);
            const DVec<D> offset = corner - point_[i];
            const double distance = data.steps.empty() ? static_cast<double>(data.distance[sample])
                                                       : static_cast<double>(data.steps[sample]);
            radius_[i] = length(offset);
            corner_[i] = corner;
            // For a corner on the surface the offset has no direction.
            normal_[i] = radius_[i] > 1e-3 * static_cast<double>(data.cell)
                             ? offset * ((distance < 0 ? -1 : 1) / radius_[i])
                             : DVec<D>(normal);
        }
    }

    /// The signed distance of a place from a plane.
    double above(const DVec<D>& place, std::size_t i) const { return dot(place - point_[i], normal_[i]); }
    DVec<D> onto(const DVec<D>& place, std::size_t i) const { return place - normal_[i] * above(place, i); }

    /// The index of the nearest closest point.
    std::size_t nearest(const DVec<D>& place) const {
        std::size_t result = 0;
        for (std::size_t i = 1; i < count; ++i)
            if (length_squared(place - point_[i]) < length_squared(place - point_[result])) result = i;
        return result;
    }
    const DVec<D>& point(std::size_t i) const { return point_[i]; }

    /// Projects a place onto the planes. Outside a convex region, or inside a concave one, it is projected onto the
    /// farthest plane repeatedly and converges to a face, an edge or a corner. Otherwise it is projected onto the
    /// nearest plane.
    DVec<D> projected(DVec<D> place, bool outside, double start) const {
        double parting = 0;
        for (std::size_t i = 0; i < count; ++i)
            for (int a = 0; a < D; ++a) parting += (i >> a & 1) != 0 ? normal_[i][a] : -normal_[i][a];
        const bool parts = parting > 0;
        if (outside != parts) {
            std::size_t nearest = 0;
            for (std::size_t i = 1; i < count; ++i)
                if (std::abs(above(place, i)) < std::abs(above(place, nearest))) nearest = i;
            return onto(place, nearest);
        }
        constexpr int max_steps = 8;
        for (int step = 0; step < max_steps; ++step) {
            std::size_t farthest = 0;
            double max_distance = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const double here = parts ? above(place, i) : -above(place, i);
                if (i == 0 || here > max_distance) {
                    max_distance = here;
                    farthest = i;
                }
            }
            place = onto(place, farthest);
            if (max_distance < start) break;
        }
        return place;
    }

    /// A lower bound of the distance to the surface: each corner is the center of a ball free of it.
    double free_around(const DVec<D>& place) const {
        double result = 0;
        for (std::size_t i = 0; i < count; ++i) result = std::max(result, radius_[i] - length(place - corner_[i]));
        return result;
    }

private:
    static constexpr std::size_t count = cell_corners<D>;

    std::array<DVec<D>, count> point_, normal_, corner_;
    std::array<double, count> radius_;
};

/// The best candidate from the closest points of the cell's corners and the planes through them.
template <int D>
Vec<D> closest_by_planes(const Field<D>& field, const Vec<D>& point, const FieldStencil<D>& stencil) {
    const FieldData<D>& data = field.data();
    const auto cell = static_cast<double>(data.cell);
    const FieldSample<D> here = field.sample(point);
    const DVec<D> place(point);
    const Planes<D> planes(data, stencil, here.normal);
    const std::size_t nearest = planes.nearest(place);
    const double max_distance = length(place - planes.point(nearest)) * (1 + 1e-6);
    const double min_distance = planes.free_around(place) - 1e-3 * cell;
    // The interpolated distance has this error near edges, which the planes find better.
    const float tolerance = data.lookup == FieldLookup::gradient ? 0.1f * data.cell : 0.3f * data.cell;
    const auto is_plausible = [&](const DVec<D>& found) {
        const double reach = length(found - place);
        return reach <= max_distance && reach >= min_distance &&
               std::abs(field.distance(to_float<D>(found))) <= tolerance;
    };
    const DVec<D> projected = planes.projected(place, here.distance > 0, 1e-3 * cell);
    if (is_plausible(projected)) return to_float<D>(projected);
    const DVec<D> on_nearest = planes.onto(place, nearest);
    return to_float<D>(is_plausible(on_nearest) ? on_nearest : planes.point(nearest));
}

}  // namespace

template <int D>
Vec<D> Field<D>::closest(const Vec<D>& point) const {
    detail::enter_library();
    ABUT_ASSERT(is_finite<D>(point));
    const Aabb<D> volume = volume_of(*data_);
    Vec<D> start = point;
    for (int a = 0; a < D; ++a)
        start[a] = start[a] >= volume.min[a] ? std::min(start[a], volume.max[a]) : volume.min[a];
    const FieldData<D>& data = *data_;
    if (data.closest.empty()) return descend(*this, start);
    // Without a brick here, it descends until it reaches one.
    constexpr int max_steps = 32;
    for (int i = 0; i < max_steps; ++i) {
        const FieldStencil<D> stencil = stencil_of(data, start);
        if (!stencil.coarse) return closest_by_planes(*this, start, stencil);
        const FieldSample<D> here = sample(start);
        for (int a = 0; a < D; ++a)
            start[a] = std::clamp(start[a] - here.distance * here.normal[a], volume.min[a], volume.max[a]);
    }
    return descend(*this, start);
}

template Vec2 Field<2>::closest(const Vec2&) const;
template Vec3 Field<3>::closest(const Vec3&) const;

}  // namespace abut
