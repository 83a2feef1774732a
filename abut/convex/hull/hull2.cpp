// The hull in 2D: a monotone chain with exact orientation tests.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/math/detail/radix_sort.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

/// A copy of a point, because the points are far apart in memory.
struct NumberedPoint {
    Vec2 point{0.0f};
    std::uint32_t number = 0;
};

/// The candidates with one x: the lowest and the highest, of copies the first. They may be equal.
struct HullColumn {
    NumberedPoint lowest, highest;
};

constexpr std::size_t worth_filtering = 64, worth_counting = 2048;

/// Akl-Toussaint octagon: eight extreme points, and a test for points surely inside.
class Octagon {
public:
    explicit Octagon(std::span<const Vec2> points) {
        // Counter-clockwise from the lowest. Any of several equal ones will do.
        std::array<DVec<2>, 8> corners;
        corners.fill(DVec<2>(points[0]));
        const auto reaches = [](const DVec<2>& p) {
            return std::array{-p.y, p.x - p.y, p.x, p.x + p.y, p.y, p.y - p.x, -p.x, -p.x - p.y};
        };
        std::array<double, 8> reach = reaches(corners[0]);
        for (const Vec2& point : points) {
            const DVec<2> p(point);
            const std::array<double, 8> found = reaches(p);
            bool farther = false;
            for (std::size_t i = 0; i < 8; ++i) farther |= found[i] > reach[i];
            if (!farther) continue;
            for (std::size_t i = 0; i < 8; ++i)
                if (found[i] > reach[i]) {
                    reach[i] = found[i];
                    corners[i] = p;
                }
        }
        const double width = reach[2] + reach[6], height = reach[4] + reach[0];
        for (std::size_t i = 0; i < 8; ++i) {
            const DVec<2> along = corners[(i + 1) % 8] - corners[i];
            if (along == DVec<2>(0.0)) continue;
            // Each product has three roundings of 2^-53, their difference one more; twice that.
            const double rounding_error = 0x1p-50 * (std::abs(along.x) * height + std::abs(along.y) * width);
            edges_[count_++] = {corners[i], along, rounding_error};
        }
        if (count_ == 2) {
            const std::array ends{to_float(edges_[0].from), to_float(edges_[1].from)};
            const bool in_order = less(ends[0], ends[1]);
            least_ = ends[in_order ? 0 : 1];
            greatest_ = ends[in_order ? 1 : 0];
        }
        // The box between the diagonal corners.
        const DVec<2> low(std::max(corners[7].x, corners[5].x), std::max(corners[7].y, corners[1].y));
        const DVec<2> high(std::min(corners[1].x, corners[3].x), std::min(corners[3].y, corners[5].y));
        if (count_ >= 3 && low.x < high.x && low.y < high.y && left_of_all(low) && left_of_all(high) &&
            left_of_all({low.x, high.y}) && left_of_all({high.x, low.y})) {
            box_low_ = low;
            box_high_ = high;
        }
    }

    bool surely_inside(const Vec2& point) const {
        const DVec<2> p(point);
        if (p.x > box_low_.x && p.x < box_high_.x && p.y > box_low_.y && p.y < box_high_.y) return true;
        return count_ == 2 ? between(point) : count_ >= 3 && left_of_all(p);
    }

private:
    struct Edge {
        DVec<2> from{0.0}, along{0.0};
        double rounding_error = 0;  ///< of the cross product with the vector to any point
    };

    /// For two extreme points: on the line between them, exactly.
    bool between(const Vec2& point) const {
        return less(least_, point) && less(point, greatest_) && orientation(least_, greatest_, point) == 0;
    }

    bool left_of_all(const DVec<2>& p) const {
        for (std::size_t i = 0; i < count_; ++i) {
            const Edge& edge = edges_[i];
            if (!(edge.along.x * (p.y - edge.from.y) - edge.along.y * (p.x - edge.from.x) > edge.rounding_error))
                return false;
        }
        return true;
    }

    std::array<Edge, 8> edges_;
    std::size_t count_ = 0;
    Vec2 least_{0.0f}, greatest_{0.0f};     ///< if there are only two
    DVec<2> box_low_{0.0}, box_high_{0.0};  ///< an open box inside; empty if none was found
};

struct KeyedPoint {
    std::uint32_t key;  ///< in the order of x
    NumberedPoint point;
};

/// A stable sort by key.
void sort(std::vector<KeyedPoint>& candidates) {
    const auto key = [](const KeyedPoint& candidate) { return candidate.key; };
    if (candidates.size() < worth_counting) {
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const KeyedPoint& a, const KeyedPoint& b) { return a.key < b.key; });
        return;
    }
    std::vector<KeyedPoint> other(candidates.size());
    if (radix_sort(candidates.data(), other.data(), candidates.size(), 32, key) == other.data()) candidates.swap(other);
}

std::vector<KeyedPoint> candidates_of(std::span<const Vec2> points) {
    std::vector<KeyedPoint> result;
    result.reserve(points.size());
    const auto add = [&](std::uint32_t i) { result.push_back({key_of(points[i].x), {points[i], i}}); };
    if (points.size() < worth_filtering) {
        for (std::uint32_t i = 0; i < points.size(); ++i) add(i);
        return result;
    }
    const Octagon octagon(points);
    for (std::uint32_t i = 0; i < points.size(); ++i)
        if (!octagon.surely_inside(points[i])) add(i);
    return result;
}

/// Columns by increasing x, without the points that are surely inside of eight extreme points (Akl, Toussaint: "A fast
/// convex hull algorithm", 1978). The points are finite; there is at least one. O(n).
std::vector<HullColumn> hull_columns(std::span<const Vec2> points) {
    std::vector<KeyedPoint> candidates = candidates_of(points);
    sort(candidates);
    std::vector<HullColumn> result;
    result.reserve(candidates.size());
    for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
        HullColumn column{candidates[begin].point, candidates[begin].point};
        for (end = begin + 1; end < candidates.size() && candidates[end].key == candidates[begin].key; ++end) {
            const NumberedPoint& next = candidates[end].point;
            if (next.point.y < column.lowest.point.y) column.lowest = next;
            if (next.point.y > column.highest.point.y) column.highest = next;
        }
        result.push_back(column);
    }
    return result;
}

/// Twice the area of the triangle abc, in double.
double area(const Vec2& a, const Vec2& b, const Vec2& c) {
    return cross(DVec<2>(b) - DVec<2>(a), DVec<2>(c) - DVec<2>(a));
}

Vec2 farthest_from(const Vec2& from, std::span<const Vec2> points) {
    return *std::max_element(points.begin(), points.end(), [&](const Vec2& a, const Vec2& b) {
        return length_squared(DVec<2>(a) - DVec<2>(from)) < length_squared(DVec<2>(b) - DVec<2>(from));
    });
}

/// Reduces a loop no wider than the tolerance to its longest segment.
void flatten(std::vector<Vec2>& loop) {
    Vec2 a = farthest_from(loop[0], loop), b = farthest_from(a, loop);
    if (less(b, a)) std::swap(a, b);
    const auto [right, left] = std::minmax_element(
        loop.begin(), loop.end(), [&](const Vec2& p, const Vec2& q) { return area(a, b, p) < area(a, b, q); });
    const double length_ab = length(DVec<2>(b) - DVec<2>(a));
    if ((area(a, b, *left) - area(a, b, *right)) / length_ab <= hull_tolerance * extent<2>(loop)) loop = {a, b};
}

}  // namespace

std::vector<std::uint32_t> hull_loop(std::span<const Vec2> points) {
    const std::vector<HullColumn> columns = hull_columns(points);
    const NumberedPoint &least = columns.front().lowest, &greatest = columns.back().highest;
    if (least.point == greatest.point) return {least.number};

    // The lower chain from the least point to the greatest, then the upper chain back. Each omits its last point, where
    // the other begins.
    std::vector<NumberedPoint> loop{least};
    std::size_t first = 0;
    const auto append = [&](const NumberedPoint& next) {
        if (next.number == loop.back().number) return;
        while (loop.size() >= first + 2 && orientation(loop[loop.size() - 2].point, loop.back().point, next.point) <= 0)
            loop.pop_back();
        loop.push_back(next);
    };
    for (const HullColumn& column : columns) append(column.lowest);
    append(greatest);
    first = loop.size() - 1;
    for (auto column = columns.rbegin(); column != columns.rend(); ++column) append(column->highest);
    append(least);
    loop.pop_back();
    std::vector<std::uint32_t> result;
    result.reserve(loop.size());
    for (const NumberedPoint& corner : loop) result.push_back(corner.number);
    return result;
}

Result<Hull2> hull(std::span<const Vec2> points) {
    if (auto problem = problem_with(points)) return *problem;
    Hull2 result;
    for (const std::uint32_t i : hull_loop(points)) result.points.push_back(without_negative_zero(points[i]));
    if (result.points.size() > 2) flatten(result.points);
    result.rank = static_cast<int>(std::min<std::size_t>(result.points.size() - 1, 2));
    return result;
}

}  // namespace abut::detail
