#include <abut/convex/farthest_point.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/round_outwards.hpp>
#include <abut/math/detail/no_index.hpp>
#include <abut/math/detail/round_outwards.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

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

namespace {

constexpr double far_away = 1e4, below = 1e-11, min_pivot = 1e-9;
constexpr int max_steps = 100;

/// The vertex of three planes, with the cost as a sum of their normals.
struct Corner {
    std::array<Plane<3>, 3> planes;
    std::array<std::uint32_t, 3> number{no_index, no_index, no_index};
    std::array<double, 3> weight{};

    /// x with normal[0] x[0] + normal[1] x[1] + normal[2] x[2] == v.
    std::array<double, 3> parts(const DVec<3>& v) const {
        const DVec<3>&a = planes[0].normal, &b = planes[1].normal, &c = planes[2].normal;
        const double inverse = 1 / dot(a, cross(b, c));
        return {dot(v, cross(b, c)) * inverse, dot(v, cross(c, a)) * inverse, dot(v, cross(a, b)) * inverse};
    }
    DVec<3> point() const {
        const DVec<3>&a = planes[0].normal, &b = planes[1].normal, &c = planes[2].normal;
        return (cross(b, c) * planes[0].offset + cross(c, a) * planes[1].offset + cross(a, b) * planes[2].offset) /
               dot(a, cross(b, c));
    }
};

}  // namespace

std::optional<DVec<3>> lowest_above(std::span<const Plane<3>> planes, const DVec<3>& cost, double size) {
    // Without planes: the lowest point of a large box.
    Corner corner;
    for (std::size_t i = 0; i < 3; ++i) {
        const int along = static_cast<int>(i);
        const double sign = cost[along] < 0 ? -1 : 1;
        corner.planes[i] = {axis<3>(along, sign), -far_away * size};
        corner.weight[i] = sign * cost[along];
    }
    for (int step = 0; step < max_steps; ++step) {
        const DVec<3> p = corner.point();
        std::uint32_t entering = no_index;
        double depth = below * size;
        for (std::uint32_t i = 0; i < planes.size(); ++i) {
            const double under = planes[i].offset - dot(planes[i].normal, p);
            if (under > depth) {
                depth = under;
                entering = i;
            }
        }
        if (entering == no_index) {
            for (const std::uint32_t number : corner.number)
                if (number == no_index) return std::nullopt;
            return p;
        }
        const std::array<double, 3> parts = corner.parts(planes[entering].normal);
        std::size_t leaving = 3;
        for (std::size_t i = 0; i < 3; ++i)
            if (parts[i] > min_pivot &&
                (leaving == 3 || corner.weight[i] * parts[leaving] < corner.weight[leaving] * parts[i]))
                leaving = i;
        if (leaving == 3) return std::nullopt;
        const double weight = corner.weight[leaving] / parts[leaving];
        for (std::size_t i = 0; i < 3; ++i) corner.weight[i] -= weight * parts[i];
        corner.weight[leaving] = weight;
        corner.planes[leaving] = planes[entering];
        corner.number[leaving] = entering;
    }
    return std::nullopt;
}

namespace {

/// In the frame, where the body has a size of about 1. `lowest_above` may be below planes by half of this, and the
/// rounding of doubles is far smaller. Floats near 0 are closer together than that.
constexpr double min_rise = 2e-11;

/// A plane this far inside of the points is that of a triangle that rounding has folded over.
constexpr double folded = 1e-3;

/// Hulls that miss a point are tried again, farther out.
constexpr int max_margins = 14;
constexpr double first_margin = 0x1p-40, margin_factor = 8;

/// The lowest of the float points around a position in the world that are above all planes.
template <int D>
std::optional<Vec<D>> lowest_around(const DVec<D>& place, std::span<const Plane<D>> planes,
                                    const StretchedFrame<D>& frame) {
    std::optional<Vec<D>> result;
    double min_sum = std::numeric_limits<double>::max();
    for (unsigned choice = 0; choice < 1u << D; ++choice) {
        Vec<D> candidate;
        for (int i = 0; i < D; ++i)
            candidate[i] = (choice >> i & 1u) == 0 ? float_at_most(place[i]) : float_at_least(place[i]);
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

/// A float point near `corner` that is above, or on, all planes of the corner. Then it contains all that the planes and
/// the corner contain. Corner and planes are in the frame, the point is in the world; -0 becomes 0. Nothing if there is
/// none in the range of floats. Above is meant to the rounding of doubles.
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
        for (int axis = 0; axis < D; ++axis) rise[i] += std::abs(normal[axis]) * float_spacing(place[axis]);
        if (!std::isfinite(rise[i])) return std::nullopt;
    }
    const DVec<D> step = raised(corner, planes, rise) - low;
    for (const double share : {0.0, 0.0625, 0.125, 0.25, 0.375, 0.5, 0.75, 1.0, 2.0, 4.0})
        if (const std::optional<Vec<D>> found = lowest_around(frame.to_world(low + step * share), planes, frame))
            return found;
    return std::nullopt;
}

/// The corners of a body in floats: outside of their planes by `margin`, after these were moved outwards to all points.
/// Nothing if one leaves the range of floats.
template <int D>
std::optional<std::vector<Vec<D>>> rounded_corners(const OuterBody<D>& body, std::span<const DVec<D>> points,
                                                   double margin, const StretchedFrame<D>& frame) {
    std::vector<Plane<D>> planes = body.planes, through;
    std::vector<bool> is_folded;
    for (Plane<D>& plane : planes) {
        const double offset = plane.offset;
        for (const DVec<D>& point : points) plane.offset = std::max(plane.offset, dot(plane.normal, point));
        is_folded.push_back(D == 3 && plane.offset - offset > folded);
        plane.offset += margin;
    }
    std::vector<Vec<D>> result;
    for (std::size_t i = 0; i < body.corners.size(); ++i) {
        through.clear();
        for (const std::uint32_t plane : body.through[i])
            if (!is_folded[plane]) through.push_back(planes[plane]);
        const std::optional<Vec<D>> corner = rounded_corner<D>(body.corners[i], through, frame);
        if (!corner) return std::nullopt;
        result.push_back(*corner);
    }
    return result;
}

}  // namespace

template <int D>
std::optional<HullOf<D>> smallest_rounded(std::vector<OuterBody<D>> bodies, std::span<const Vec<D>> points,
                                          std::size_t limit, const StretchedFrame<D>& frame) {
    std::vector<DVec<D>> seen;
    for (const Vec<D>& point : points) seen.push_back(frame.from_world(DVec<D>(point)));
    std::optional<HullOf<D>> best;
    if (limit >= 1u << D) {
        const auto [low, high] = min_max<D>(points);
        std::vector<Vec<D>> box;
        for (unsigned choice = 0; choice < 1u << D; ++choice) {
            DVec<D> corner;
            for (int i = 0; i < D; ++i) corner[i] = (choice >> i & 1u) == 0 ? low[i] : high[i];
            box.push_back(without_negative_zero(to_float(corner)));
        }
        best = hull_around(box, points, frame);
    }
    std::stable_sort(bodies.begin(), bodies.end(), [](const auto& a, const auto& b) { return a.size < b.size; });
    for (const OuterBody<D>& body : bodies) {
        // Rounding only adds to the size.
        if (best && size_of(*best) <= body.size) break;
        double margin = 0;
        for (int i = 0; i < max_margins; ++i) {
            const auto corners = rounded_corners<D>(body, seen, margin, frame);
            if (!corners) break;
            if (std::optional<HullOf<D>> next = hull_around(*corners, points, frame)) {
                if (!best || size_of(*next) < size_of(*best)) best = std::move(next);
                break;
            }
            margin = margin == 0 ? first_margin : margin_factor * margin;
        }
    }
    return best;
}

template std::optional<Hull2> smallest_rounded(std::vector<OuterBody<2>>, std::span<const Vec2>, std::size_t,
                                               const StretchedFrame<2>&);
template std::optional<Hull3> smallest_rounded(std::vector<OuterBody<3>>, std::span<const Vec3>, std::size_t,
                                               const StretchedFrame<3>&);

}  // namespace abut::detail
