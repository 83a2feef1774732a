#include <abut/convex/hull_input.hpp>
#include <abut/convex/round_out.hpp>
#include <abut/math/dvec.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace abut {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr int most_steps = 200;

/// The floats around a number, the lesser one first.
std::array<float, 2> around(double value) {
    const auto nearest = static_cast<float>(value);
    const auto back = static_cast<double>(nearest);
    if (back == value) return {nearest, nearest};
    return back < value ? std::array{nearest, std::nextafter(nearest, infinity)}
                        : std::array{std::nextafter(nearest, -infinity), nearest};
}

/// The lowest of the points of floats around a place that are above all planes.
template <int D>
std::optional<Vec<D>> lowest_around(const DVec<D>& place, std::span<const Plane<D>> planes) {
    std::array<std::array<float, 2>, static_cast<std::size_t>(D)> floats{};
    for (int i = 0; i < D; ++i) floats[static_cast<std::size_t>(i)] = around(place[i]);
    std::optional<Vec<D>> result;
    double least = std::numeric_limits<double>::max();
    for (unsigned choice = 0; choice < 1u << D; ++choice) {
        Vec<D> candidate;
        for (int i = 0; i < D; ++i) candidate[i] = floats[static_cast<std::size_t>(i)][choice >> i & 1u];
        if (!is_finite<D>(candidate)) continue;
        double sum = 0;
        bool above = true;
        for (const Plane<D>& plane : planes) {
            const double height = dot(plane.normal, DVec<D>(candidate)) - plane.offset;
            above = above && height >= 0;
            sum += height;
        }
        if (!above || !(sum < least)) continue;
        least = sum;
        result = without_negative_zero(candidate);
    }
    return result;
}

/// A way that rises above all planes alike.
DVec<2> way_out(std::span<const Plane<2>> planes) {
    DVec<2> sum(0.0);
    for (const Plane<2>& plane : planes) sum += plane.normal;
    return normalized(sum);
}
DVec<3> way_out(std::span<const Plane<3>> planes) {
    DVec<3> sum(0.0);
    std::vector<Plane<3>> one_up;
    for (const Plane<3>& plane : planes) {
        sum += plane.normal;
        one_up.push_back({plane.normal, 1});
    }
    return normalized(lowest_above(one_up, sum, 1e3).value_or(sum));
}

}  // namespace

template <int D>
std::optional<Vec<D>> rounded_out(const DVec<D>& corner, std::span<const Plane<D>> planes) {
    const DVec<D> way = way_out(planes);
    const auto size = static_cast<float>(largest(corner));
    const double least_step = 0.125 * static_cast<double>(std::nextafter(size, infinity) - size);
    double along = 0;
    for (int step = 0; step < most_steps; ++step) {
        if (const std::optional<Vec<D>> found = lowest_around(corner + way * along, planes)) return found;
        along = along == 0 ? least_step : along * 1.25;
    }
    return std::nullopt;
}

template <int D>
std::vector<Vec<D>> corners_of_box(std::span<const Vec<D>> points, std::size_t limit) {
    const DVec<D> low = least_corner<D>(points), high = greatest_corner<D>(points);
    std::vector<Vec<D>> result;
    if (limit >= std::size_t{1} << D) {
        for (unsigned choice = 0; choice < 1u << D; ++choice) {
            DVec<D> corner = low;
            for (int i = 0; i < D; ++i)
                if ((choice >> i & 1u) != 0) corner[i] = high[i];
            result.push_back(to_float(corner));
        }
        return result;
    }
    result.push_back(to_float(low));
    for (int i = 0; i < D; ++i) {
        Vec<D> corner = result[0];
        corner[i] = std::nextafter(static_cast<float>(low[i] + D * 1.000001 * (high[i] - low[i])), infinity);
        if (!is_finite<D>(corner)) return {};
        result.push_back(corner);
    }
    return result;
}

template std::vector<Vec2> corners_of_box(std::span<const Vec2>, std::size_t);
template std::vector<Vec3> corners_of_box(std::span<const Vec3>, std::size_t);
template std::optional<Vec2> rounded_out(const DVec<2>&, std::span<const Plane<2>>);
template std::optional<Vec3> rounded_out(const DVec<3>&, std::span<const Plane<3>>);

}  // namespace abut
