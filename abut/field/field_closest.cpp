// Points of a field's surface.

#include <abut/field/field.hpp>
#include <abut/field/field_spot.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace abut {
namespace {

/// Down the distance until the surface is as good as reached; of the places on the way that where it is nearest.
template <int D>
Vec<D> walked_down(const Field<D>& field, Vec<D> place) {
    constexpr int most_steps = 32;
    const FieldData<D>& data = field.data();
    const Aabb<D> volume = volume_of(data);
    Vec<D> best = place;
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i < most_steps; ++i) {
        const FieldSample<D> here = field.sample(place);
        if (std::abs(here.distance) < least) {
            least = std::abs(here.distance);
            best = place;
        }
        if (least <= 1e-4f * data.cell) break;
        for (int a = 0; a < D; ++a)
            place[a] = std::clamp(place[a] - here.distance * here.normal[a], volume.min[a], volume.max[a]);
    }
    return best;
}

/// The planes that touch the surface at the closest points of a cell's corners.
template <int D>
class Planes {
public:
    Planes(const FieldData<D>& data, const FieldSpot<D>& spot, const Vec<D>& normal) {
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t sample = spot.corner(i);
            DVec<D> corner;
            for (int a = 0; a < D; ++a)
                corner[a] = static_cast<double>(data.origin[a]) +
                            static_cast<double>(data.cell) * static_cast<double>(spot.low[a] + (i >> a & 1));
            point_[i] = DVec<D>(data.closest[sample]);
            const DVec<D> way = corner - point_[i];
            const double distance = data.steps.empty() ? static_cast<double>(data.distance[sample])
                                                       : static_cast<double>(data.steps[sample]);
            reach_[i] = length(way);
            corner_[i] = corner;
            // Of a corner on the surface itself the way tells nothing.
            normal_[i] = reach_[i] > 1e-3 * static_cast<double>(data.cell) ? way * ((distance < 0 ? -1 : 1) / reach_[i])
                                                                           : DVec<D>(normal);
        }
    }

    /// How far up a plane a place is.
    double above(const DVec<D>& place, std::size_t i) const { return dot(place - point_[i], normal_[i]); }
    DVec<D> onto(const DVec<D>& place, std::size_t i) const { return place - normal_[i] * above(place, i); }

    /// The closest point that is nearest.
    std::size_t nearest(const DVec<D>& place) const {
        std::size_t result = 0;
        for (std::size_t i = 1; i < count; ++i)
            if (length_squared(place - point_[i]) < length_squared(place - point_[result])) result = i;
        return result;
    }
    const DVec<D>& point(std::size_t i) const { return point_[i]; }

    /// On all planes that matter. Outside of what is convex, or within what is hollow, one after another is gone down
    /// to, that which is farthest first; it comes to rest on a face, an edge or a corner. Else on the nearest plane.
    DVec<D> reached(DVec<D> place, bool outside, double near) const {
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
        constexpr int most_steps = 8;
        for (int step = 0; step < most_steps; ++step) {
            std::size_t farthest = 0;
            double most = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const double here = parts ? above(place, i) : -above(place, i);
                if (i == 0 || here > most) {
                    most = here;
                    farthest = i;
                }
            }
            place = onto(place, farthest);
            if (most < near) break;
        }
        return place;
    }

    /// No point of the surface is nearer: the corners keep balls free of it.
    double free_around(const DVec<D>& place) const {
        double result = 0;
        for (std::size_t i = 0; i < count; ++i) result = std::max(result, reach_[i] - length(place - corner_[i]));
        return result;
    }

private:
    static constexpr std::size_t count = cell_corners<D>;

    std::array<DVec<D>, count> point_, normal_, corner_;
    std::array<double, count> reach_;
};

/// Of the closest points of the cell's corners, and the planes through them: the best that can be vouched for.
template <int D>
Vec<D> told_by_corners(const Field<D>& field, const Vec<D>& point, const FieldSpot<D>& spot) {
    const FieldData<D>& data = field.data();
    const auto cell = static_cast<double>(data.cell);
    const FieldSample<D> here = field.sample(point);
    const DVec<D> place(point);
    const Planes<D> planes(data, spot, here.normal);
    const std::size_t nearest = planes.nearest(place);
    const double most = length(place - planes.point(nearest)) * (1 + 1e-6);
    const double least = planes.free_around(place) - 1e-3 * cell;
    // The interpolated distance is off by as much near edges that the planes find better.
    const float doubt = data.lookup == FieldLookup::gradient ? 0.1f * data.cell : 0.3f * data.cell;
    const auto holds = [&](const DVec<D>& found) {
        const double reach = length(found - place);
        return reach <= most && reach >= least && std::abs(field.distance(to_float<D>(found))) <= doubt;
    };
    const DVec<D> reached = planes.reached(place, here.distance > 0, 1e-3 * cell);
    if (holds(reached)) return to_float<D>(reached);
    const DVec<D> beside = planes.onto(place, nearest);
    return to_float<D>(holds(beside) ? beside : planes.point(nearest));
}

}  // namespace

template <int D>
Vec<D> Field<D>::closest(const Vec<D>& point) const {
    ABUT_ASSERT(is_finite<D>(point));
    const Aabb<D> volume = volume_of(*data_);
    Vec<D> near = point;
    for (int a = 0; a < D; ++a) near[a] = near[a] >= volume.min[a] ? std::min(near[a], volume.max[a]) : volume.min[a];
    const FieldData<D>& data = *data_;
    if (data.closest.empty()) return walked_down(*this, near);
    // Where there is no brick, down to where there is one.
    constexpr int most_steps = 32;
    for (int i = 0; i < most_steps; ++i) {
        const FieldSpot<D> spot = spot_of(data, near);
        if (!spot.coarse) return told_by_corners(*this, near, spot);
        const FieldSample<D> here = sample(near);
        for (int a = 0; a < D; ++a)
            near[a] = std::clamp(near[a] - here.distance * here.normal[a], volume.min[a], volume.max[a]);
    }
    return walked_down(*this, near);
}

template Vec2 Field<2>::closest(const Vec2&) const;
template Vec3 Field<3>::closest(const Vec3&) const;

}  // namespace abut
