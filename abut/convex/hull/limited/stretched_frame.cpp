#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/limited/stretched_frame.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace abut::detail {
namespace {

/// Differences of floats are exact, or rounded far below the precision of a float.
template <int D>
std::array<DVec<D>, D> axes_of(std::span<const Vec<D>> corners) {
    const auto farthest = [&](auto distance) {
        return DVec<D>(corners[farthest_of(corners, [&](const Vec<D>& p) { return distance(DVec<D>(p)); })]);
    };
    const DVec<D> from = farthest([&](const DVec<D>& p) { return length_squared(p - DVec<D>(corners[0])); });
    const DVec<D> to = farthest([&](const DVec<D>& p) { return length_squared(p - from); });
    const DVec<D> along = normalized(to - from);
    if constexpr (D == 2) {
        return {along, DVec<2>(-along.y, along.x)};
    } else {
        // Orthogonalised twice, for the cancellation of nearly collinear points.
        DVec<3> aside = farthest([&](const DVec<3>& p) { return length_squared(cross(along, p - from)); }) - from;
        for (int round = 0; round < 2; ++round) aside = normalized(aside - along * dot(along, aside));
        return {along, aside, cross(along, aside)};
    }
}

}  // namespace

template <int D>
std::optional<StretchedFrame<D>> stretched_frame(std::span<const Vec<D>> corners, std::span<const Vec<D>> points) {
    const std::array<DVec<D>, D> axes = axes_of<D>(corners);
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

template std::optional<StretchedFrame<2>> stretched_frame(std::span<const Vec2>, std::span<const Vec2>);
template std::optional<StretchedFrame<3>> stretched_frame(std::span<const Vec3>, std::span<const Vec3>);

}  // namespace abut::detail
