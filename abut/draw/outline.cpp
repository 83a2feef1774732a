// A polygon inscribed in a convex set by its support function alone. Between two points of the outline a and b lies
// something exactly if the farthest point along the normal of the chord ab lies beyond the chord:
//
//        m
//      .---.            gain(m) > tolerance: m is a new point, go on with am and mb
//     /     \           else the chord is the outline
//    a-------b
//
// The sandwich algorithm, after Rote, "The convergence rate of the sandwich algorithm for approximating convex
// functions" (1992): the error falls with the square of the number of points, and corners are found exactly.

#include <abut/draw/outline.hpp>

#include <array>
#include <utility>

namespace abut {
namespace {

/// Of the set's size. A circle becomes 64 points.
constexpr double curve_tolerance = 1.0 / 800;
/// Corners closer to the chord than this are nobody's to see.
constexpr double corner_tolerance = 1e-6;
/// Halvings of a quarter: a bound for support functions that contradict themselves.
constexpr int deepest = 12;
/// Directions are turned by this angle within their plane: where a whole side is equally far, the point is a corner of
/// the outline then, and not what rounding makes of it.
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
    DVec<2> seen(const DVec<D>& v) const { return {dot(plane_.x, v), dot(plane_.y, v)}; }

    void add(const DVec<D>& point) {
        const Vec<D> position = to_float(point);
        if (points_.empty() || points_.back() != position) points_.push_back(position);
    }

    void add_between(const DVec<D>& a, const DVec<D>& b, int depth) {
        const DVec<2> chord = seen(b - a);
        if (depth == deepest || !(length(chord) > tolerance_)) return;
        const DVec<2> out = normalized(DVec<2>(chord.y, -chord.x));
        const DVec<D> middle = farthest(out);
        if (!(dot(seen(middle - a), out) > tolerance_)) return;
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

}  // namespace abut
