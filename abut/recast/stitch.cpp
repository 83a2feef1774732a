#include <abut/math/detail/no_index.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/recast/stitch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace abut::detail {
namespace {

/// The projection along the second axis.
DVec<2> flat(const DVec<3>& p) {
    return {p.x, p.z};
}

/// Maps corners above one another, within a step each, to the lowest of them.
std::vector<std::uint32_t> merge_corners(std::span<const DVec<3>> corners, double step) {
    const auto key = [&](std::uint32_t i) { return std::tuple(corners[i].x, corners[i].z, corners[i].y, i); };
    std::vector<std::uint32_t> order(corners.size()), same(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t k = 0; k < order.size(); ++k) {
        const std::uint32_t i = order[k];
        same[i] = i;
        if (k == 0) continue;
        const std::uint32_t below = order[k - 1];
        if (flat(corners[below]) == flat(corners[i]) && corners[i].y - corners[below].y <= step) same[i] = same[below];
    }
    return same;
}

/// A point on a side of a polygon, or another corner on it.
struct SidePoint {
    std::uint32_t from, to;  ///< the corners, the lower number first
    double along;            ///< in [0, 1], from `from`
    double height;
    std::uint32_t polygon, point, corner;

    auto key() const { return std::tuple(from, to, along, height, polygon, point, corner); }
};

class Stitcher {
public:
    Stitcher(std::span<const DVec<3>> corners, std::span<const CutPolygon> polygons, const StitchOptions& options)
        : polygons_(polygons), options_(options), same_(merge_corners(corners, options.step)) {
        result_.points.assign(corners.begin(), corners.end());
        for (const CutPolygon& polygon : polygons)
            number_.emplace_back(std::max(polygon.points.size(), polygon.corners.size()), no_index);
    }

    Stitched run() {
        for (std::uint32_t i = 0; i < polygons_.size(); ++i) number_points(i);
        join_sides();
        for (std::uint32_t i = 0; i < polygons_.size(); ++i) add_triangles(i);
        return std::move(result_);
    }

private:
    std::uint32_t corner(const CutPolygon& polygon, std::size_t i) const {
        return same_[polygon.corners[i % polygon.corners.size()]];
    }

    std::uint32_t add_point(const DVec<3>& point) {
        result_.points.push_back(point);
        return static_cast<std::uint32_t>(result_.points.size() - 1);
    }

    /// Numbers the corners and inner points, and collects the points on sides.
    void number_points(std::uint32_t index) {
        const CutPolygon& polygon = polygons_[index];
        const std::size_t count = polygon.corners.size();
        const bool is_thin = has_no_area(polygon);
        for (std::size_t i = 0; i < count; ++i) {
            number_[index][i] = corner(polygon, i);
            for (std::size_t k = 0; k < count && is_thin; ++k)
                if (std::optional<SidePoint> found = on_side(polygon, k, result_.points[corner(polygon, i)])) {
                    found->corner = corner(polygon, i);
                    on_sides_.push_back(*found);
                }
        }
        for (std::size_t i = count; i < polygon.points.size() && !is_thin; ++i) {
            double nearest_distance = std::numeric_limits<double>::infinity();
            std::optional<SidePoint> nearest;
            for (std::size_t k = 0; k < count; ++k) {
                double away = 0;
                const std::optional<SidePoint> found = on_side(polygon, k, polygon.points[i], &away);
                if (!found || !(away < nearest_distance)) continue;
                nearest_distance = away;
                nearest = found;
            }
            if (nearest) {
                nearest->polygon = index;
                nearest->point = static_cast<std::uint32_t>(i);
                on_sides_.push_back(*nearest);
            } else {
                number_[index][i] = add_point(polygon.points[i]);
            }
        }
    }

    /// The position of a point on a side, if it lies on it.
    std::optional<SidePoint> on_side(const CutPolygon& polygon, std::size_t side_number, const DVec<3>& point,
                                     double* off = nullptr) const {
        const std::uint32_t a = corner(polygon, side_number), b = corner(polygon, side_number + 1);
        const std::uint32_t from = std::min(a, b), to = std::max(a, b);
        const DVec<2> start = flat(result_.points[from]), side = flat(result_.points[to]) - start;
        const DVec<2> offset = flat(point) - start;
        const double square = dot(side, side), along = dot(offset, side) / square;
        const double away = std::abs(cross(side, offset)) / square_root(square);
        if (off != nullptr) *off = away;
        if (!(away <= options_.tolerance) || !(along > 0 && along < 1)) return std::nullopt;
        return SidePoint{from, to, along, point.y, no_index, no_index, no_index};
    }

    /// True if all corners are collinear. Such a polygon only splits the sides of its neighbours.
    bool has_no_area(const CutPolygon& polygon) const {
        double sum = 0;
        for (std::size_t i = 1; i + 1 < polygon.corners.size(); ++i)
            sum += area({corner(polygon, 0), corner(polygon, i), corner(polygon, i + 1)});
        return std::abs(sum) <= options_.tolerance * options_.tolerance;
    }

    /// Numbers the points on sides: points of several polygons at the same position get one number.
    void join_sides() {
        std::sort(on_sides_.begin(), on_sides_.end(),
                  [](const SidePoint& a, const SidePoint& b) { return a.key() < b.key(); });
        for (std::size_t i = 0; i < on_sides_.size();) {
            const SidePoint first = on_sides_[i];
            const DVec<3> from = result_.points[first.from], to = result_.points[first.to];
            const double tolerance = options_.tolerance / length(flat(to) - flat(from));
            double sum = 0;
            std::size_t end = i;
            std::uint32_t number = no_index;
            for (; end < on_sides_.size(); ++end) {
                const SidePoint& next = on_sides_[end];
                if (next.from != first.from || next.to != first.to || next.along - first.along > tolerance) break;
                sum += next.height;
                number = std::min(number, next.corner);
            }
            if (number == no_index) {
                DVec<3> point = from + (to - from) * first.along;
                point.y = sum / static_cast<double>(end - i);
                number = add_point(point);
            }
            for (; i < end; ++i)
                if (on_sides_[i].point != no_index) number_[on_sides_[i].polygon][on_sides_[i].point] = number;
            cuts_.push_back({first.from, first.to, first.along, number});
        }
    }

    /// A split of the side between two corners.
    struct Cut {
        std::uint32_t from, to;
        double along;
        std::uint32_t number;
    };

    std::span<const Cut> cuts_between(std::uint32_t from, std::uint32_t to) const {
        const auto before = [](const Cut& cut, const std::pair<std::uint32_t, std::uint32_t>& side) {
            return std::pair(cut.from, cut.to) < side;
        };
        const auto first = std::lower_bound(cuts_.begin(), cuts_.end(), std::pair(from, to), before);
        auto last = first;
        while (last != cuts_.end() && last->from == from && last->to == to) ++last;
        return {first, last};
    }

    /// The corners and splits around a polygon: one list per side, with both its ends.
    using Sides = std::vector<std::vector<std::uint32_t>>;
    Sides sides_of(const CutPolygon& polygon) const {
        Sides result;
        for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
            const std::uint32_t a = corner(polygon, i), b = corner(polygon, i + 1);
            const std::span<const Cut> cuts = cuts_between(std::min(a, b), std::max(a, b));
            std::vector<std::uint32_t>& side = result.emplace_back(1, a);
            for (std::size_t k = 0; k < cuts.size(); ++k) side.push_back(cuts[a < b ? k : cuts.size() - 1 - k].number);
            side.push_back(b);
        }
        return result;
    }

    /// Twice the projected area along the second axis, positive if the triangle faces along it.
    double area(const glm::uvec3& t) const {
        const DVec<2> a = flat(result_.points[t.x]);
        return -cross(flat(result_.points[t.y]) - a, flat(result_.points[t.z]) - a);
    }

    void add_triangles(std::uint32_t index) {
        const CutPolygon& polygon = polygons_[index];
        if (has_no_area(polygon)) return;
        const Sides sides = sides_of(polygon);
        std::vector<glm::uvec3> triangles;
        for (const glm::uvec3& t : polygon.triangles)
            add_triangle({number_[index][t.x], number_[index][t.y], number_[index][t.z]}, sides, triangles);
        std::vector<std::uint32_t> boundary;
        for (const std::vector<std::uint32_t>& side : sides)
            boundary.insert(boundary.end(), side.begin(), side.end() - 1);
        if (!fills(triangles, boundary)) {
            triangles = cut_from_middle(polygon, boundary);
            ++result_.repaired;
        }
        result_.triangles.insert(result_.triangles.end(), triangles.begin(), triangles.end());
    }

    std::vector<glm::uvec3> cut_from_middle(const CutPolygon& polygon, std::span<const std::uint32_t> boundary) {
        DVec<3> middle(0.0);
        for (std::size_t i = 0; i < polygon.corners.size(); ++i) middle += result_.points[corner(polygon, i)];
        const std::uint32_t number = add_point(middle / static_cast<double>(polygon.corners.size()));
        std::vector<glm::uvec3> result;
        for (std::size_t i = 0; i < boundary.size(); ++i) {
            const glm::uvec3 t{number, boundary[i], boundary[(i + 1) % boundary.size()]};
            result.push_back(area(t) < 0 ? glm::uvec3(t.x, t.z, t.y) : t);
        }
        return result;
    }

    /// The middle split between a and b if both are on one side; otherwise none.
    static std::uint32_t cut_between(std::uint32_t a, std::uint32_t b, const Sides& sides) {
        for (const std::vector<std::uint32_t>& side : sides) {
            const auto at = std::find(side.begin(), side.end(), a), to = std::find(side.begin(), side.end(), b);
            if (at == side.end() || to == side.end()) continue;
            const auto first = std::min(at, to), last = std::max(at, to);
            return last - first > 1 ? *(first + (last - first) / 2) : no_index;
        }
        return no_index;
    }

    /// Adds a triangle, split at all points on its sides. A triangle without area is removed.
    void add_triangle(glm::uvec3 t, const Sides& sides, std::vector<glm::uvec3>& triangles) const {
        if (area(t) < 0) std::swap(t.y, t.z);
        if (!has_area(t)) return;
        std::vector<glm::uvec3> stack{t};
        while (!stack.empty()) {
            const glm::uvec3 next = stack.back();
            stack.pop_back();
            bool uncut = true;
            for (int k = 0; k < 3 && uncut; ++k) {
                const std::uint32_t a = next[k], b = next[(k + 1) % 3], c = next[(k + 2) % 3];
                const std::uint32_t cut = cut_between(a, b, sides);
                if (cut == no_index) continue;
                uncut = false;
                stack.push_back({a, cut, c});
                stack.push_back({cut, b, c});
            }
            if (uncut) triangles.push_back(next);
        }
    }

    bool has_area(const glm::uvec3& t) const { return area(t) > options_.tolerance * options_.tolerance; }

    /// True if all triangles have an area and their boundary is the given one.
    bool fills(std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> boundary) const {
        using Side = std::pair<std::uint32_t, std::uint32_t>;
        double total = 0, sum = 0;
        for (std::size_t i = 1; i + 1 < boundary.size(); ++i)
            total += area({boundary[0], boundary[i], boundary[i + 1]});
        std::vector<Side> sides, border, needed;
        for (const glm::uvec3& t : triangles) {
            if (!has_area(t)) return false;
            sum += area(t);
            for (int k = 0; k < 3; ++k) sides.emplace_back(t[k], t[(k + 1) % 3]);
        }
        for (std::size_t i = 0; i < boundary.size(); ++i) {
            const std::uint32_t a = boundary[i], b = boundary[(i + 1) % boundary.size()];
            needed.push_back(total > 0 ? Side(a, b) : Side(b, a));
        }
        std::sort(sides.begin(), sides.end());
        std::sort(needed.begin(), needed.end());
        for (const Side& side : sides)
            if (!std::binary_search(sides.begin(), sides.end(), Side(side.second, side.first))) border.push_back(side);
        return std::adjacent_find(sides.begin(), sides.end()) == sides.end() && border == needed &&
               std::abs(sum - std::abs(total)) <= 1e-9 * std::abs(total);
    }

    std::span<const CutPolygon> polygons_;
    StitchOptions options_;
    std::vector<std::uint32_t> same_;
    std::vector<std::vector<std::uint32_t>> number_;  ///< one list per polygon: numbers of its points in the result
    std::vector<SidePoint> on_sides_;
    std::vector<Cut> cuts_;  ///< sorted by sides, then along them
    Stitched result_;
};

}  // namespace

Stitched stitch(std::span<const DVec<3>> corners, std::span<const CutPolygon> polygons, const StitchOptions& options) {
    return Stitcher(corners, polygons, options).run();
}

}  // namespace abut::detail
