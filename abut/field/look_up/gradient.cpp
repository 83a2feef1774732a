// Interpolation from distances and gradients.
//
// Each corner of a cell extrapolates the distance by a plane. The average of the interpolated distances and the
// interpolated planes is exact for quadratic distances: on smooth surfaces the two errors are equal and opposite. Near
// an edge of the surface the distance isn't smooth. There it is about the maximum of the planes if gradients diverge,
// as at a convex edge, or the minimum if they converge, as at a concave edge. The difference from the linear distance
// separates the cases: the weight of the plane grows from 0, on flat surfaces, to 1 at a sixteenth of a cell.

#include <abut/field/look_up/look_up.hpp>
#include <abut/field/packed_direction.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace abut::detail {
namespace {

template <int D>
float dot_of(const Vec<D>& a, const Vec<D>& b) {
    float result = a[0] * b[0];
    for (int k = 1; k < D; ++k) result = result + a[k] * b[k];
    return result;
}

/// Pairwise summation: the order determines the bits.
float sum(const std::array<float, 4>& v) {
    return (v[0] + v[1]) + (v[2] + v[3]);
}
float sum(const std::array<float, 8>& v) {
    return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

template <int D>
FieldSample<D> sample_reference(const FieldData<D>& data, const Vec<D>& point) {
    constexpr std::size_t corners = cell_corners<D>;
    const FieldStencil<D> stencil = stencil_of(data, point);
    const std::array<float, corners> values = corner_values(data, stencil);
    const float unit = unit_of(data, stencil);
    if (stencil.coarse) {
        const float per_length = data.frame.inverse * (1.0f / brick_cells<D>);
        return {linear(values, stencil.fraction) * unit,
                direction_of(slope(values, stencil.fraction) * (unit * per_length))};
    }

    // All values are in cells from here on.
    const float scale = unit * data.frame.inverse;
    std::array<float, corners> distance, plane;
    std::array<Vec<D>, corners> gradient;
    std::array<float, corners> outward;  // component of a gradient away from the cell's center
    float max_plane = 0, min_plane = 0;
    std::size_t max_corner = 0, min_corner = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        distance[i] = values[i] * scale;
        gradient[i] = unpacked<D>(data.direction[stencil.corner(i)]);
        Vec<D> offset;
        for (int a = 0; a < D; ++a) {
            const bool upper = i >> a & 1;
            offset[a] = upper ? stencil.fraction[a] - 1 : stencil.fraction[a];
            const float part = upper ? gradient[i][a] : -gradient[i][a];
            outward[i] = a == 0 ? part : outward[i] + part;
        }
        plane[i] = distance[i] + dot_of<D>(gradient[i], offset);
        if (i == 0 || plane[i] > max_plane) {
            max_plane = plane[i];
            max_corner = i;
        }
        if (i == 0 || plane[i] < min_plane) {
            min_plane = plane[i];
            min_corner = i;
        }
    }
    const float interpolated = linear(distance, stencil.fraction), extrapolated = linear(plane, stencil.fraction);
    const float smooth = 0.5f * (interpolated + extrapolated);
    const bool is_convex = sum(outward) > 0;
    const float sharp = is_convex ? max_plane : min_plane;
    const float difference = is_convex ? interpolated - sharp : sharp - interpolated;
    const float weight = std::clamp(16 * difference, 0.0f, 1.0f);
    const float found = lerp(smooth, sharp, weight);

    const Vec<D> rise = slope(distance, stencil.fraction), plane_rise = slope(plane, stencil.fraction);
    const Vec<D>& edge_gradient = gradient[is_convex ? max_corner : min_corner];
    const float change = weight > 0 && weight < 1 ? (is_convex ? 16.0f : -16.0f) * (sharp - smooth) : 0.0f;
    Vec<D> result;
    for (int a = 0; a < D; ++a) {
        std::array<float, corners> along;
        for (std::size_t i = 0; i < corners; ++i) along[i] = gradient[i][a];
        const float smooth_rise = 0.5f * (rise[a] + (plane_rise[a] + linear(along, stencil.fraction)));
        result[a] = lerp(smooth_rise, edge_gradient[a], weight) + change * (rise[a] - edge_gradient[a]);
    }
    return {found * data.cell, direction_of(result)};
}

// The same operations for 3D in SIMD, in the same order.

using field_lanes::Ends;
using lanes::Floats4;
using lanes::Ints4;

/// Four gradients.
struct Gradients {
    Floats4 x, y, z;

    /// Unpacks the lower 16 bits of each lane.
    explicit Gradients(Ints4 bits) {
        x = lanes::converted(bits << 24 >> 24) * Floats4(1.0f / 127);
        y = lanes::converted(bits << 16 >> 24) * Floats4(1.0f / 127);
        z = 1 - lanes::magnitude(x) - lanes::magnitude(y);
        const Floats4 fold = lanes::greater(-z, Floats4(0));
        x = x - lanes::flipped_by(fold, x);
        y = y - lanes::flipped_by(fold, y);
        const Floats4 inverse = 1 / lanes::root(x * x + y * y + z * z);
        x = x * inverse;
        y = y * inverse;
        z = z * inverse;
    }
};

template <bool with_normal>
FieldSample<3> sample_simd(const FieldData<3>& data, const Vec3& point) {
    const field_lanes::Stencil at = field_lanes::stencil(data, Floats4{point.x, point.y, point.z, 0});
    if (at.coarse) return field_lanes::sample(data, Floats4{point.x, point.y, point.z, 0});

    // Lanes of `low` are the corners 0, 2, 4 and 6, those of `high` 1, 3, 5 and 7.
    const bool steps = data.step != 0;
    const float unit = steps ? data.step : 1.0f;
    const Floats4 scale = Floats4(unit * data.frame.inverse);
    Ends distance = steps ? field_lanes::ends(data.steps.data() + at.first, at.row, at.slice)
                          : field_lanes::ends(data.distance.data() + at.first, at.row, at.slice);
    distance = {distance.low * scale, distance.high * scale};
    const std::uint16_t* directions = data.direction.data() + at.first;
    const std::uint16_t* const pairs[4] = {directions, directions + at.row, directions + at.slice,
                                           directions + at.row + at.slice};
    const Gradients low(Ints4{pairs[0][0], pairs[1][0], pairs[2][0], pairs[3][0]}),
        high(Ints4{pairs[0][1], pairs[1][1], pairs[2][1], pairs[3][1]});

    const Floats4 x = Floats4(at.fraction[0]), y = Floats4(at.fraction[1]) - Floats4{0, 1, 0, 1},
                  z = Floats4(at.fraction[2]) - Floats4{0, 0, 1, 1};
    const Ends plane{distance.low + (low.x * x + low.y * y + low.z * z),
                     distance.high + (high.x * (x - 1) + high.y * y + high.z * z)};
    const Floats4 lower_y{-1, 1, -1, 1}, lower_z{-1, -1, 1, 1};
    const Floats4 outward = (-low.x + lanes::flipped_by(low.y, lower_y) + lanes::flipped_by(low.z, lower_z)) +
                            (high.x + lanes::flipped_by(high.y, lower_y) + lanes::flipped_by(high.z, lower_z));
    const bool is_convex = (outward[0] + outward[1]) + (outward[2] + outward[3]) > 0;

    const Floats4 interpolated = field_lanes::distance_and_slope(distance, at.fraction),
                  extrapolated = field_lanes::distance_and_slope(plane, at.fraction);
    const float smooth = 0.5f * (interpolated[0] + extrapolated[0]);
    const float sharp = is_convex ? lanes::greatest_lane(lanes::greater(plane.low, plane.high))
                                  : lanes::least_lane(lanes::lesser(plane.low, plane.high));
    const float difference = is_convex ? interpolated[0] - sharp : sharp - interpolated[0];
    const float weight = std::clamp(16 * difference, 0.0f, 1.0f);
    FieldSample<3> result{lerp(smooth, sharp, weight) * data.cell, {1, 0, 0}};
    if constexpr (!with_normal) return result;

    const std::uint32_t is_low = lanes::bits(plane.low == Floats4(sharp));
    const std::uint32_t is_high = lanes::bits(plane.high == Floats4(sharp));
    const auto lane = static_cast<std::size_t>(std::countr_zero(is_low | is_high | 8u));
    const Gradients& of = (is_low >> lane & 1) != 0 ? low : high;
    const Vec3 edge_gradient(of.x[lane], of.y[lane], of.z[lane]);
    const Vec3 along(field_lanes::distance_of({low.x, high.x}, at.fraction),
                     field_lanes::distance_of({low.y, high.y}, at.fraction),
                     field_lanes::distance_of({low.z, high.z}, at.fraction));
    const float change = weight > 0 && weight < 1 ? (is_convex ? 16.0f : -16.0f) * (sharp - smooth) : 0.0f;
    Vec3 rise;
    for (int a = 0; a < 3; ++a) {
        const auto slope_lane = static_cast<std::size_t>(a) + 1;
        const float slope = interpolated[slope_lane];
        const float smooth_rise = 0.5f * (slope + (extrapolated[slope_lane] + along[a]));
        rise[a] = lerp(smooth_rise, edge_gradient[a], weight) + change * (slope - edge_gradient[a]);
    }
    result.normal = direction_of(rise);
    return result;
}

}  // namespace

FieldSample<2> gradient_sample(const FieldData<2>& data, const Vec2& point) {
    return sample_reference<2>(data, point);
}
FieldSample<3> gradient_sample(const FieldData<3>& data, const Vec3& point) {
    return sample_simd<true>(data, point);
}
float gradient_distance(const FieldData<2>& data, const Vec2& point) {
    return sample_reference<2>(data, point).distance;
}
float gradient_distance(const FieldData<3>& data, const Vec3& point) {
    return sample_simd<false>(data, point).distance;
}
FieldSample<3> gradient_sample_reference(const FieldData<3>& data, const Vec3& point) {
    return sample_reference<3>(data, point);
}

}  // namespace abut::detail
