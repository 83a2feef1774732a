// Hulls with a vertex limit in 2D.

#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/limited_hull.hpp>
#include <abut/convex/hull/limited/minimum_box.hpp>
#include <abut/convex/hull/limited/outer_polygon.hpp>
#include <abut/convex/hull/limited/round_outwards.hpp>
#include <abut/convex/hull/limited/stretched_frame.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

constexpr int max_margins2 = 14;
constexpr double first_margin2 = 0x1p-40;

template <class Point>
double area_of(std::span<const Point> loop) {
    double twice = 0;
    const DVec<2> origin(loop[0]);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        twice += cross(DVec<2>(loop[i]) - origin, DVec<2>(loop[i + 1]) - origin);
    return 0.5 * twice;
}

/// The hull of the corners, if it contains all points, exactly.
std::optional<Hull2> hull_around(std::span<const Vec2> corners, std::span<const Vec2> points) {
    Hull2 result{{}, 2};
    for (const std::uint32_t i : hull_loop(corners)) result.points.push_back(corners[i]);
    const std::size_t count = result.points.size();
    if (count < 3) return std::nullopt;
    for (std::size_t i = 0; i < count; ++i)
        for (const Vec2& point : points)
            if (orientation(result.points[i], result.points[(i + 1) % count], point) < 0) return std::nullopt;
    return result;
}

class LimitedHull2Search {
public:
    LimitedHull2Search(std::span<const Vec2> points, std::size_t limit, const Affine<2>& shown,
                       const StretchedFrame<2>& frame)
        : points_(points), limit_(limit), frame_(frame) {
        for (const Vec2& point : points) inner_.push_back(frame.from_world(DVec<2>(point)));
        offer_rectangle(shown);
        loops_.push_back(outer_polygon(inner_, limit));
    }

    /// Rounding only adds area: a loop no smaller than the best result is skipped.
    std::optional<Hull2> smallest_rounded() const {
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t i = 0; i < loops_.size(); ++i)
            order.emplace_back(area_of<DVec<2>>(loops_[i]) * determinant(frame_.out), i);
        std::sort(order.begin(), order.end());
        std::optional<Hull2> best = bounding_box();
        for (const auto& [area, number] : order) {
            if (best && area_of<Vec2>(best->points) <= area) break;
            std::optional<Hull2> next = rounded(loops_[number]);
            if (next && (!best || area_of<Vec2>(next->points) < area_of<Vec2>(best->points))) best = std::move(next);
        }
        return best;
    }

private:
    /// The minimum oriented rectangle, or the triangle around it.
    void offer_rectangle(const Affine<2>& shown) {
        std::vector<DVec<2>> loop;
        for (const DVec<2>& point : inner_) loop.push_back(shown.vector(frame_.out.vector(point)));
        const DVec<2> along = minimum_rectangle(loop), across(-along.y, along.x);
        const auto extremes = [&](const DVec<2>& axis) {
            const auto [low, high] = std::minmax_element(
                loop.begin(), loop.end(), [&](const auto& a, const auto& b) { return dot(axis, a) < dot(axis, b); });
            return std::pair(dot(axis, *low), dot(axis, *high));
        };
        const auto [left, right] = extremes(along);
        const auto [low, high] = extremes(across);
        const Affine<2> back = inverse(shown, determinant(shown));
        std::vector<DVec<2>>& offered = loops_.emplace_back();
        for (const DVec<2>& unit : around_unit_cube<2>(limit_)) {
            const DVec<2> place = along * (left + (right - left) * unit.x) + across * (low + (high - low) * unit.y);
            offered.push_back(frame_.into.vector(back.vector(place)));
        }
        if (area_of<DVec<2>>(offered) < 0) std::reverse(offered.begin(), offered.end());
    }

    /// The corners of a loop in floats, each outside of its two edges by `margin`. Nothing if one leaves the range of
    /// floats.
    std::optional<std::vector<Vec2>> rounded_corners(std::span<const DVec<2>> loop, double margin) const {
        const std::size_t count = loop.size();
        std::vector<Plane<2>> lines;
        for (std::size_t i = 0; i < count; ++i) {
            const DVec<2> along = loop[(i + 1) % count] - loop[i], normal = normalized(DVec<2>(along.y, -along.x));
            double offset = dot(normal, loop[i]);
            for (const DVec<2>& point : inner_) offset = std::max(offset, dot(normal, point));
            lines.push_back({normal, offset + margin});
        }
        std::vector<Vec2> result;
        for (std::size_t i = 0; i < count; ++i) {
            const Plane<2> both[] = {lines[(i + count - 1) % count], lines[i]};
            const std::optional<Vec2> corner = rounded_corner<2>(loop[i], both, frame_);
            if (!corner) return std::nullopt;
            result.push_back(*corner);
        }
        return result;
    }

    std::optional<Hull2> rounded(std::span<const DVec<2>> loop) const {
        double margin = 0;
        for (int i = 0; i < max_margins2; ++i) {
            const std::optional<std::vector<Vec2>> corners = rounded_corners(loop, margin);
            if (!corners) return std::nullopt;
            if (std::optional<Hull2> result = hull_around(*corners, points_)) return result;
            margin = margin == 0 ? first_margin2 : 8 * margin;
        }
        return std::nullopt;
    }

    /// The bounding box, whose corners are floats, or a triangle around it.
    std::optional<Hull2> bounding_box() const {
        for (const double growth : {0x1p-20, 0x1p-10, 1.0}) {
            const std::vector<Vec2> corners = corners_of_box<2>(points_, limit_, growth);
            if (corners.empty()) return std::nullopt;
            if (std::optional<Hull2> result = hull_around(corners, points_)) return result;
        }
        return std::nullopt;
    }

    std::span<const Vec2> points_;
    std::size_t limit_;
    const StretchedFrame<2>& frame_;
    std::vector<DVec<2>> inner_;  ///< the points in the frame
    std::vector<std::vector<DVec<2>>> loops_;
};

}  // namespace

std::optional<Hull2> outline_of(std::span<const Vec2> hull_points, std::size_t limit, const Affine<2>& seen) {
    const std::optional<StretchedFrame<2>> frame = stretched_frame(hull_points, hull_points);
    if (!frame) return std::nullopt;
    return LimitedHull2Search(hull_points, limit, seen, *frame).smallest_rounded();
}

Result<Hull2> limited_hull(std::span<const Vec2> points, const HullOptions& options) {
    if (options.added != nullptr) *options.added = 0;
    if (options.max_vertices != 0 && options.max_vertices < 3)
        return Problem{
            ProblemCode::bad_argument,
            "max_vertices is " + std::to_string(options.max_vertices) + ", and an area has 3 corners or more", 0};
    Result<Hull2> full = hull(points);
    if (!full || options.max_vertices == 0 || full->points.size() <= options.max_vertices) return full;
    std::optional<Hull2> result = outline_of(full->points, options.max_vertices, {});
    if (!result) return beyond_floats();
    if (options.added != nullptr) *options.added = area_of<Vec2>(result->points) - area_of<Vec2>(full->points);
    return *std::move(result);
}

}  // namespace abut::detail
