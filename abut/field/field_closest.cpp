// Points of a field's surface.

#include <abut/field/field.hpp>
#include <abut/field/field_spot.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/dvec.hpp>

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

}  // namespace

template <int D>
Vec<D> Field<D>::closest(const Vec<D>& point) const {
    ABUT_ASSERT(is_finite<D>(point));
    const Aabb<D> volume = volume_of(*data_);
    Vec<D> near = point;
    for (int a = 0; a < D; ++a) near[a] = near[a] >= volume.min[a] ? std::min(near[a], volume.max[a]) : volume.min[a];
    return walked_down(*this, near);
}

template Vec2 Field<2>::closest(const Vec2&) const;
template Vec3 Field<3>::closest(const Vec3&) const;

}  // namespace abut
