#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/limited/stretched_frame.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace abut::detail {
namespace {

template <int D>
using Axes = std::array<DVec<D>, static_cast<std::size_t>(D)>;

/// Differences of floats are exact, or rounded far below the precision of a float.
template <int D>
DVec<D> longest_direction(std::span<const Vec<D>> corners, const DVec<D>& from, DVec<D>& to) {
    to = DVec<D>(corners[farthest_of(corners, [&](const Vec<D>& p) { return length_squared(DVec<D>(p) - from); })]);
    return normalized(to - from);
}

Axes<2> axes_of(std::span<const Vec2> corners) {
    DVec<2> a(0.0), b(0.0);
    longest_direction<2>(corners, DVec<2>(corners[0]), a);
    const DVec<2> along = longest_direction<2>(corners, a, b);
    return {along, DVec<2>(-along.y, along.x)};
}

Axes<3> axes_of(std::span<const Vec3> corners) {
    DVec<3> a(0.0), b(0.0);
    longest_direction<3>(corners, DVec<3>(corners[0]), a);
    const DVec<3> along = longest_direction<3>(corners, a, b);
    const DVec<3> c(
        corners[farthest_of(corners, [&](const Vec3& p) { return length_squared(cross(along, DVec<3>(p) - a)); })]);
    // Orthogonalised twice, for the cancellation of nearly collinear points.
    DVec<3> aside = c - a;
    for (int round = 0; round < 2; ++round) aside = normalized(aside - along * dot(along, aside));
    return {along, aside, cross(along, aside)};
}

template <int D>
std::optional<StretchedFrame<D>> frame_of(std::span<const Vec<D>> corners, std::span<const Vec<D>> points) {
    const Axes<D> axes = axes_of(corners);
    StretchedFrame<D> result;
    result.origin = DVec<D>(corners[0]);
    for (int i = 0; i < D; ++i) {
        const auto number = static_cast<std::size_t>(i);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec<D>& point : points) {
            const double along = dot(axes[number], DVec<D>(point) - result.origin);
            low = std::min(low, along);
            high = std::max(high, along);
        }
        const double size = high - low, middle = 0.5 * (low + high);
        if (!(size > std::numeric_limits<double>::min())) return std::nullopt;
        for (int j = 0; j < D; ++j) result.into.column[static_cast<std::size_t>(j)][i] = axes[number][j] / size;
        result.into.offset[i] = -middle / size;
        result.out.column[number] = axes[number] * size;
        result.out.offset += axes[number] * middle;
    }
    return result;
}

}  // namespace

std::optional<StretchedFrame<2>> stretched_frame(std::span<const Vec2> corners, std::span<const Vec2> points) {
    return frame_of<2>(corners, points);
}

std::optional<StretchedFrame<3>> stretched_frame(std::span<const Vec3> corners, std::span<const Vec3> points) {
    return frame_of<3>(corners, points);
}

}  // namespace abut::detail
