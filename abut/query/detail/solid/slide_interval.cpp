#include <abut/math/dvec.hpp>
#include <abut/query/detail/solid/slide_interval.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {
namespace {

/// Separating axes closer to zero than this, relative to the lengths that they are products of, are noise.
constexpr double parallel = 1e-10;

/// An overlap along an axis that is smaller than this, relative to the triangles, may be rounding.
constexpr double flush = 1e-13;

struct AxisRange {
    double min, max;
};

AxisRange range_along(const DVec<3>& axis, const Corners& t) {
    const double a = dot(axis, t[0]), b = dot(axis, t[1]), c = dot(axis, t[2]);
    return {std::min({a, b, c}), std::max({a, b, c})};
}

/// Intersects the intervals of the separating axes.
class Slide {
public:
    Slide(const Corners& a, const Corners& b, const DVec<3>& direction, const SlideRange& range)
        : a_(a), b_(b), direction_(direction), range_(range) {}

    /// Returns false if no distance is left, or not the range.
    bool cut(const DVec<3>& axis) {
        const AxisRange a = range_along(axis, a_), b = range_along(axis, b_);
        const double speed = dot(axis, direction_);
        if (speed * speed <= 1e-26 * length_squared(axis)) {
            const double tolerance =
                flush * std::max({std::abs(a.min), std::abs(a.max), std::abs(b.min), std::abs(b.max)});
            return b.min + tolerance < a.max && a.min + tolerance < b.max;
        }
        const double to = (speed > 0 ? a.max - b.min : a.min - b.max) / speed;
        const double from = (speed > 0 ? a.min - b.max : a.max - b.min) / speed;
        from_ = std::max(from_, from);
        if (to < to_) {
            to_ = to;
            exit_axis_ = speed > 0 ? axis : -axis;
        }
        return from_ < to_ && from_ < range_.from_before && to_ > range_.to_beyond;
    }
    SlideInterval interval() const { return {from_, to_, exit_axis_ / length(exit_axis_)}; }
    bool ends() const { return to_ < std::numeric_limits<double>::infinity(); }

private:
    const Corners &a_, &b_;
    const DVec<3>& direction_;
    SlideRange range_;
    double from_ = -std::numeric_limits<double>::infinity(), to_ = std::numeric_limits<double>::infinity();
    DVec<3> exit_axis_{0.0};
};

}  // namespace

bool slide_interval(const Corners& a_world, const Corners& b_world, const DVec<3>& direction, const SlideRange& range,
                    SlideInterval& interval) {
    // Relative to a corner, so that rounding is that of the triangles' sizes.
    const DVec<3> origin = a_world[0];
    Corners a = a_world, b = b_world;
    for (std::size_t i = 0; i < 3; ++i) {
        a[i] -= origin;
        b[i] -= origin;
    }
    const std::array<DVec<3>, 3> edges_a{a[1] - a[0], a[2] - a[1], a[0] - a[2]},
        edges_b{b[1] - b[0], b[2] - b[1], b[0] - b[2]};
    const DVec<3> normal_a = cross(edges_a[0], edges_a[1]), normal_b = cross(edges_b[0], edges_b[1]);
    Slide slide(a, b, direction, range);
    const double size_a = length(normal_a), size_b = length(normal_b);
    if (size_a == 0 || size_b == 0) return false;
    if (length(cross(normal_a, normal_b)) <= parallel * size_a * size_b) {
        // In one plane, or never: a distance at which parallel triangles pass each other is a single one.
        if (std::abs(dot(normal_a, direction)) > 1e-13 * size_a || dot(normal_a, normal_b) < 0) return false;
        const double apart = std::abs(dot(normal_a, b[0])) / size_a;
        const double scale =
            std::max(largest(edges_a[0]) + largest(edges_a[1]), largest(edges_b[0]) + largest(edges_b[1]));
        if (apart > 1e-12 * scale) return false;
        for (const DVec<3>& edge : edges_a)
            if (!slide.cut(cross(normal_a, edge))) return false;
        for (const DVec<3>& edge : edges_b)
            if (!slide.cut(cross(normal_b, edge))) return false;
    } else {
        if (!slide.cut(normal_a) || !slide.cut(normal_b)) return false;
        for (const DVec<3>& edge_a : edges_a)
            for (const DVec<3>& edge_b : edges_b) {
                const DVec<3> axis = cross(edge_a, edge_b);
                if (length_squared(axis) <= parallel * parallel * length_squared(edge_a) * length_squared(edge_b))
                    continue;
                if (!slide.cut(axis)) return false;
            }
    }
    if (!slide.ends()) return false;
    interval = slide.interval();
    return true;
}

}  // namespace abut::detail
