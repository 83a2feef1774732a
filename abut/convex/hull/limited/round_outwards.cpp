#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/round_outwards.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace abut::detail {
namespace {

/// In the frame, where the body has a size of about 1. `lowest_above` may be below planes by half of this, and the
/// rounding of doubles is far smaller. Floats near 0 are closer together than that.
constexpr double min_rise = 2e-11;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// The floats below and above a number.
std::array<float, 2> around(double value) {
    const auto nearest = static_cast<float>(value);
    const auto back = static_cast<double>(nearest);
    if (back == value) return {nearest, nearest};
    return back < value ? std::array{nearest, std::nextafter(nearest, infinity)}
                        : std::array{std::nextafter(nearest, -infinity), nearest};
}

/// The lowest of the float points around a position in the world that are above all planes.
template <int D>
std::optional<Vec<D>> lowest_around(const DVec<D>& place, std::span<const Plane<D>> planes,
                                    const StretchedFrame<D>& frame) {
    std::array<std::array<float, 2>, static_cast<std::size_t>(D)> floats{};
    for (int i = 0; i < D; ++i) floats[static_cast<std::size_t>(i)] = around(place[i]);
    std::optional<Vec<D>> result;
    double min_sum = std::numeric_limits<double>::max();
    for (unsigned choice = 0; choice < 1u << D; ++choice) {
        Vec<D> candidate;
        for (int i = 0; i < D; ++i) candidate[i] = floats[static_cast<std::size_t>(i)][choice >> i & 1u];
        if (!is_finite<D>(candidate)) continue;
        const DVec<D> seen = frame.from_world(DVec<D>(candidate));
        double sum = 0;
        bool above = true;
        for (const Plane<D>& plane : planes) {
            const double height = dot(plane.normal, seen) - plane.offset;
            above = above && height >= 0;
            sum += height;
        }
        if (!above || !(sum < min_sum)) continue;
        min_sum = sum;
        result = without_negative_zero(candidate);
    }
    return result;
}

/// The lowest position above each plane by more than its `rise`, near the corner.
DVec<2> raised(const DVec<2>& corner, std::span<const Plane<2>> planes, std::span<const double> rise) {
    const DVec<2>&a = planes[0].normal, &b = planes[1].normal;
    const double turn = cross(a, b), one = planes[0].offset + rise[0] - dot(a, corner),
                 other = planes[1].offset + rise[1] - dot(b, corner);
    constexpr double straight = 1e-6;
    if (std::abs(turn) > straight) return corner + DVec<2>(one * b.y - other * a.y, other * a.x - one * b.x) / turn;
    return corner + normalized(a + b) * (std::max(one, other) * (1 + straight));
}
DVec<3> raised(const DVec<3>& corner, std::span<const Plane<3>> planes, std::span<const double> rise) {
    DVec<3> sum(0.0);
    std::vector<Plane<3>> local;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        sum += planes[i].normal;
        local.push_back({planes[i].normal, planes[i].offset + rise[i] - dot(planes[i].normal, corner)});
    }
    // Along the mean of the normals, if that rises above all planes, no farther than necessary.
    constexpr double min_cosine = 0.1;
    const DVec<3> direction = normalized(sum);
    double along = 0;
    for (const Plane<3>& plane : local)
        along = std::max(along, dot(plane.normal, direction) > min_cosine ? plane.offset / dot(plane.normal, direction)
                                                                          : std::numeric_limits<double>::infinity());
    // Nearly equal planes intersect anywhere: the lowest position may be far to the side.
    const std::optional<DVec<3>> lowest = lowest_above(local, sum, 1);
    return corner + (lowest && length(*lowest) <= 2 * along ? *lowest : direction * along);
}

/// The distance to the next float.
double spacing(double value) {
    const auto near = static_cast<float>(std::abs(value));
    return static_cast<double>(std::nextafter(near, infinity)) - static_cast<double>(near);
}

}  // namespace

template <int D>
std::optional<Vec<D>> rounded_corner(const DVec<D>& corner, std::span<const Plane<D>> planes,
                                     const StretchedFrame<D>& frame) {
    // Rounding moves a point by less than the spacing of floats on each axis, and so below each plane by at most
    // `rise`. Around a position that high above all planes every float is above them.
    std::vector<double> rise(planes.size(), 0);
    const DVec<D> low = raised(corner, planes, rise), place = frame.to_world(low);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const DVec<D> normal = frame.into.transposed(planes[i].normal);
        rise[i] = min_rise;
        for (int axis = 0; axis < D; ++axis) rise[i] += std::abs(normal[axis]) * spacing(place[axis]);
        if (!std::isfinite(rise[i])) return std::nullopt;
    }
    const DVec<D> step = raised(corner, planes, rise) - low;
    for (const double share : {0.0, 0.0625, 0.125, 0.25, 0.375, 0.5, 0.75, 1.0, 2.0, 4.0})
        if (const std::optional<Vec<D>> found = lowest_around(frame.to_world(low + step * share), planes, frame))
            return found;
    return std::nullopt;
}

template <>
std::vector<DVec<2>> around_unit_cube<2>(std::size_t limit) {
    if (limit < 4) return {{0, 0}, {2, 0}, {0, 2}};
    return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

template <>
std::vector<DVec<3>> around_unit_cube<3>(std::size_t limit) {
    if (limit < 5) return {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
    if (limit < 6) return {{-0.25, -0.25, 0}, {1.25, -0.25, 0}, {1.25, 1.25, 0}, {-0.25, 1.25, 0}, {0.5, 0.5, 3}};
    if (limit < 8) return {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, {2, 0, 1}, {0, 2, 1}};
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
}

template <int D>
std::vector<Vec<D>> corners_of_box(std::span<const Vec<D>> points, std::size_t limit, double growth) {
    const DVec<D> low = min_corner<D>(points), high = max_corner<D>(points);
    const bool pyramid = D == 3 && limit == 5;
    std::vector<Vec<D>> result;
    for (const DVec<D>& unit : around_unit_cube<D>(pyramid ? 4 : limit)) {
        Vec<D> corner;
        for (int i = 0; i < D; ++i) {
            const double legs = unit[i] * (1 + growth), beyond = low[i] + (high[i] - low[i]) * legs;
            corner[i] = unit[i] == 0   ? static_cast<float>(low[i])
                        : unit[i] == 1 ? static_cast<float>(high[i])
                                       : std::nextafter(static_cast<float>(beyond), infinity);
        }
        if (!is_finite<D>(corner)) return {};
        result.push_back(without_negative_zero(corner));
    }
    return result;
}

template std::vector<Vec2> corners_of_box(std::span<const Vec2>, std::size_t, double);
template std::vector<Vec3> corners_of_box(std::span<const Vec3>, std::size_t, double);
template std::optional<Vec2> rounded_corner(const DVec<2>&, std::span<const Plane<2>>, const StretchedFrame<2>&);
template std::optional<Vec3> rounded_corner(const DVec<3>&, std::span<const Plane<3>>, const StretchedFrame<3>&);

}  // namespace abut::detail
