// What lies between samples, told from distances and their gradients.
//
// Each corner of a cell foretells the distance by a plane. A blend of what the corners have and what they foretell,
// half and half, weighed as linear interpolation does, is right for all distances of second degree: where the surface
// is smooth the one is off by as much as the other, in opposite directions. Near an edge of the surface it isn't
// smooth. There the distance is about the largest of the planes, if gradients part, as at the edge of something solid;
// or the smallest, if they meet, as at that of something hollow. How far that is from the linear distance tells one
// case from the other: the share of a plane grows from nothing, where the surface is flat, to one at a sixteenth of a
// cell.

#include <abut/field/field_look_up.hpp>
#include <abut/field/packed_direction.hpp>

#include <array>
#include <cstddef>

namespace abut {
namespace {

Vec2 unpacked(std::uint16_t bits, Vec2*) {
    return unpacked2(bits);
}
Vec3 unpacked(std::uint16_t bits, Vec3*) {
    return unpacked3(bits);
}

template <int D>
float dot_of(const Vec<D>& a, const Vec<D>& b) {
    float result = a[0] * b[0];
    for (int k = 1; k < D; ++k) result = result + a[k] * b[k];
    return result;
}

template <int D>
FieldSample<D> told(const FieldData<D>& data, const Vec<D>& point) {
    constexpr std::size_t corners = cell_corners<D>;
    const FieldSpot<D> spot = spot_of(data, point);
    const std::array<float, corners> values = corner_values(data, spot);
    const float unit = unit_of(data, spot);
    if (spot.coarse) {
        const float per_length = data.frame.inverse * (1.0f / brick_cells<D>);
        return {linear(values, spot.share) * unit, direction_of(slope(values, spot.share) * (unit * per_length))};
    }

    // All in cells from here on.
    const float scale = unit * data.frame.inverse;
    std::array<float, corners> distance, plane;
    std::array<Vec<D>, corners> gradient;
    float parting = 0, most = 0, least = 0;
    std::size_t most_of = 0, least_of = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        distance[i] = values[i] * scale;
        gradient[i] = unpacked(data.direction[spot.corner(i)], static_cast<Vec<D>*>(nullptr));
        Vec<D> way;
        for (int a = 0; a < D; ++a) {
            const bool upper = i >> a & 1;
            way[a] = upper ? spot.share[a] - 1 : spot.share[a];
            parting = upper ? parting + gradient[i][a] : parting - gradient[i][a];
        }
        plane[i] = distance[i] + dot_of<D>(gradient[i], way);
        if (i == 0 || plane[i] > most) {
            most = plane[i];
            most_of = i;
        }
        if (i == 0 || plane[i] < least) {
            least = plane[i];
            least_of = i;
        }
    }
    const float straight = linear(distance, spot.share), foretold = linear(plane, spot.share);
    const float smooth = 0.5f * (straight + foretold);
    const bool parts = parting > 0;
    const float sharp = parts ? most : least;
    const float gap = parts ? straight - sharp : sharp - straight;
    const float share = std::clamp(16 * gap, 0.0f, 1.0f);
    const float found = between(smooth, sharp, share);

    const Vec<D> rise = slope(distance, spot.share), plane_rise = slope(plane, spot.share);
    const Vec<D>& edge = gradient[parts ? most_of : least_of];
    const float change = share > 0 && share < 1 ? (parts ? 16.0f : -16.0f) * (sharp - smooth) : 0.0f;
    Vec<D> result;
    for (int a = 0; a < D; ++a) {
        std::array<float, corners> along;
        for (std::size_t i = 0; i < corners; ++i) along[i] = gradient[i][a];
        const float smooth_rise = 0.5f * (rise[a] + (plane_rise[a] + linear(along, spot.share)));
        result[a] = between(smooth_rise, edge[a], share) + change * (rise[a] - edge[a]);
    }
    return {found * data.cell, direction_of(result)};
}

}  // namespace

FieldSample<2> gradient_sample(const FieldData<2>& data, const Vec2& point) {
    return told<2>(data, point);
}
FieldSample<3> gradient_sample(const FieldData<3>& data, const Vec3& point) {
    return told<3>(data, point);
}

}  // namespace abut
