// An inscribed polygon of a convex set, from its support function alone. Between two points a and b of the outline, the
// outline bulges exactly if the support point along the normal of the chord ab is beyond the chord:
//
//        m
//      .---.            gain(m) > tolerance: m is a new point; continue with am and mb
//     /     \           otherwise the chord is the outline
//    a-------b
//
// The sandwich algorithm, after Rote, "The convergence rate of the sandwich algorithm for approximating convex
// functions" (1992): the error decreases with the square of the number of points, and corners are found exactly.

#include <abut/draw/outline.hpp>

#include <array>
#include <utility>

namespace abut::detail {
namespace {

/// Relative to the set's size. A circle becomes 64 points.
constexpr double curve_tolerance = 1.0 / 800;
/// Corners closer to the chord are invisible.
constexpr double corner_tolerance = 1e-6;
/// Maximum number of bisections of a quarter; a bound for inconsistent support functions.
constexpr int max_depth = 12;
/// Directions are rotated by this angle within their plane. If a whole side is equally far, the support point is then a
/// corner of the outline and not determined by rounding.
constexpr double slight_turn = 1e-7;

template <int D>
bool has_corners_only(const Convex<D>& convex) {
    return (convex.core == Core::points || convex.core == Core::box) && convex.inner_radius == 0 && convex.radius == 0;
}

template <int D>
class Outliner {
public:
    Outliner(const Convex<D>& convex, const OutlinePlane<D>& plane)
        : convex_(convex),
          plane_(plane),
          tolerance_(size(convex) * (has_corners_only(convex) ? corner_tolerance : curve_tolerance)) {}

    std::vector<Vec<D>> all() {
        const std::array<DVec<2>, 4> around{DVec<2>(1, 0), DVec<2>(0, 1), DVec<2>(-1, 0), DVec<2>(0, -1)};
        std::array<DVec<D>, 4> extreme;
        for (std::size_t i = 0; i < 4; ++i) extreme[i] = farthest(around[i]);
        for (std::size_t i = 0; i < 4; ++i) {
            add(extreme[i]);
            add_between(extreme[i], extreme[(i + 1) % 4], 0);
        }
        while (points_.size() > 1 && points_.front() == points_.back()) points_.pop_back();
        return std::move(points_);
    }

private:
    DVec<D> farthest(const DVec<2>& direction) const {
        const DVec<2> turned = direction + DVec<2>(-direction.y, direction.x) * slight_turn;
        return support(convex_, plane_.x * turned.x + plane_.y * turned.y + plane_.tilt);
    }
    DVec<2> projected(const DVec<D>& v) const { return {dot(plane_.x, v), dot(plane_.y, v)}; }

    void add(const DVec<D>& point) {
        const Vec<D> position = to_float(point);
        if (points_.empty() || points_.back() != position) points_.push_back(position);
    }

    void add_between(const DVec<D>& a, const DVec<D>& b, int depth) {
        const DVec<2> chord = projected(b - a);
        if (depth == max_depth || !(length(chord) > tolerance_)) return;
        const DVec<2> out = normalized(DVec<2>(chord.y, -chord.x));
        const DVec<D> middle = farthest(out);
        if (!(dot(projected(middle - a), out) > tolerance_)) return;
        add_between(a, middle, depth + 1);
        add(middle);
        add_between(middle, b, depth + 1);
    }

    const Convex<D>& convex_;
    const OutlinePlane<D>& plane_;
    double tolerance_;
    std::vector<Vec<D>> points_;
};

}  // namespace

template <int D>
std::vector<Vec<D>> outline(const Convex<D>& convex, const OutlinePlane<D>& plane) {
    return Outliner<D>(convex, plane).all();
}

std::vector<Vec2> outline(const Convex<2>& convex) {
    return outline(convex, OutlinePlane<2>{axis<2>(0), axis<2>(1)});
}

template std::vector<Vec2> outline(const Convex<2>&, const OutlinePlane<2>&);
template std::vector<Vec3> outline(const Convex<3>&, const OutlinePlane<3>&);

}  // namespace abut::detail
