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
#include <bit>
#include <cmath>
#include <cstddef>

namespace abut {
namespace {

template <int D>
float dot_of(const Vec<D>& a, const Vec<D>& b) {
    float result = a[0] * b[0];
    for (int k = 1; k < D; ++k) result = result + a[k] * b[k];
    return result;
}

/// By pairs: the order is part of the answer.
float sum(const std::array<float, 4>& v) {
    return (v[0] + v[1]) + (v[2] + v[3]);
}
float sum(const std::array<float, 8>& v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
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
    std::array<float, corners> outward;  // the part of a gradient that points away from the middle of the cell
    float most = 0, least = 0;
    std::size_t most_of = 0, least_of = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        distance[i] = values[i] * scale;
        gradient[i] = unpacked<D>(data.direction[spot.corner(i)]);
        Vec<D> way;
        for (int a = 0; a < D; ++a) {
            const bool upper = i >> a & 1;
            way[a] = upper ? spot.share[a] - 1 : spot.share[a];
            const float part = upper ? gradient[i][a] : -gradient[i][a];
            outward[i] = a == 0 ? part : outward[i] + part;
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
    const bool parts = sum(outward) > 0;
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

// The same in space by vectors of four, operation by operation.

using field_lanes::Ends;
using four::Floats;
using four::Mask;

Floats root(Floats v) {
#ifdef __SSE2__
    return _mm_sqrt_ps(v);
#else
    return Floats{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}
/// With the sign of another.
Floats signed_like(Floats magnitude, Floats sign) {
    constexpr auto top = static_cast<std::int32_t>(0x80000000);
    return std::bit_cast<Floats>(std::bit_cast<Mask>(magnitude) |
                                 (std::bit_cast<Mask>(sign) & Mask{top, top, top, top}));
}

/// Four gradients.
struct Gradients {
    Floats x, y, z;

    /// Of the lower 16 bits of each.
    explicit Gradients(Mask bits) {
        x = __builtin_convertvector(bits << 24 >> 24, Floats) * four::all(1.0f / 127);
        y = __builtin_convertvector(bits << 16 >> 24, Floats) * four::all(1.0f / 127);
        z = four::all(1) - four::magnitude(x) - four::magnitude(y);
        const Floats fold = four::greater(-z, four::all(0));
        x = x - signed_like(fold, x);
        y = y - signed_like(fold, y);
        const Floats inverse = four::all(1) / root(x * x + y * y + z * z);
        x = x * inverse;
        y = y * inverse;
        z = z * inverse;
    }
};

template <bool with_normal>
FieldSample<3> told_by_lanes(const FieldData<3>& data, const Vec3& point) {
    const field_lanes::Spot at = field_lanes::spot(data, Floats{point.x, point.y, point.z, 0});
    if (at.coarse) return field_lanes::sample(data, Floats{point.x, point.y, point.z, 0});

    // Lanes of `low` are the corners 0, 2, 4 and 6, of `high` 1, 3, 5 and 7.
    const bool steps = data.step != 0;
    const float unit = steps ? data.step : 1.0f;
    const Floats scale = four::all(unit * data.frame.inverse);
    Ends distance = steps ? field_lanes::ends(data.steps.data() + at.first, at.row, at.slice)
                          : field_lanes::ends(data.distance.data() + at.first, at.row, at.slice);
    distance = {distance.low * scale, distance.high * scale};
    const std::uint16_t* directions = data.direction.data() + at.first;
    Mask even, odd;
    for (int lane = 0; lane < 4; ++lane) {
        const std::uint16_t* pair = directions + (lane & 1 ? at.row : 0) + (lane & 2 ? at.slice : 0);
        even[lane] = pair[0];
        odd[lane] = pair[1];
    }
    const Gradients low(even), high(odd);

    const Floats x = four::all(at.share[0]), y = four::all(at.share[1]) - Floats{0, 1, 0, 1},
                 z = four::all(at.share[2]) - Floats{0, 0, 1, 1};
    const Ends plane{distance.low + (low.x * x + low.y * y + low.z * z),
                     distance.high + (high.x * (x - four::all(1)) + high.y * y + high.z * z)};
    constexpr auto top = static_cast<std::int32_t>(0x80000000);
    const auto turned = [](Floats v, Mask signs) { return std::bit_cast<Floats>(std::bit_cast<Mask>(v) ^ signs); };
    const Mask lower_y{top, 0, top, 0}, lower_z{top, top, 0, 0};
    const Floats outward = (-low.x + turned(low.y, lower_y) + turned(low.z, lower_z)) +
                           (high.x + turned(high.y, lower_y) + turned(high.z, lower_z));
    const bool parts = (outward[0] + outward[1]) + (outward[2] + outward[3]) > 0;

    const Floats straight = field_lanes::all_of(distance, at.share), foretold = field_lanes::all_of(plane, at.share);
    const float smooth = 0.5f * (straight[0] + foretold[0]);
    const float sharp =
        parts ? four::greatest(four::greater(plane.low, plane.high)) : four::least(four::less(plane.low, plane.high));
    const float gap = parts ? straight[0] - sharp : sharp - straight[0];
    const float share = std::clamp(16 * gap, 0.0f, 1.0f);
    FieldSample<3> result{between(smooth, sharp, share) * data.cell, {1, 0, 0}};
    if constexpr (!with_normal) return result;

    const std::uint32_t is_low = four::bits(plane.low == four::all(sharp));
    const std::uint32_t is_high = four::bits(plane.high == four::all(sharp));
    const int lane = std::countr_zero(is_low | is_high | 8u);
    const Gradients& of = (is_low >> lane & 1) != 0 ? low : high;
    const Vec3 edge(of.x[lane], of.y[lane], of.z[lane]);
    const Vec3 along(field_lanes::distance_of({low.x, high.x}, at.share),
                     field_lanes::distance_of({low.y, high.y}, at.share),
                     field_lanes::distance_of({low.z, high.z}, at.share));
    const float change = share > 0 && share < 1 ? (parts ? 16.0f : -16.0f) * (sharp - smooth) : 0.0f;
    Vec3 rise;
    for (int a = 0; a < 3; ++a) {
        const float smooth_rise = 0.5f * (straight[a + 1] + (foretold[a + 1] + along[a]));
        rise[a] = between(smooth_rise, edge[a], share) + change * (straight[a + 1] - edge[a]);
    }
    result.normal = direction_of(rise);
    return result;
}

}  // namespace

FieldSample<2> gradient_sample(const FieldData<2>& data, const Vec2& point) {
    return told<2>(data, point);
}
FieldSample<3> gradient_sample(const FieldData<3>& data, const Vec3& point) {
    return told_by_lanes<true>(data, point);
}
float gradient_distance(const FieldData<2>& data, const Vec2& point) {
    return told<2>(data, point).distance;
}
float gradient_distance(const FieldData<3>& data, const Vec3& point) {
    return told_by_lanes<false>(data, point).distance;
}
FieldSample<3> gradient_sample_plainly(const FieldData<3>& data, const Vec3& point) {
    return told<3>(data, point);
}

}  // namespace abut
