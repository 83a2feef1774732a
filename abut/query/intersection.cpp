#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/manifold/clip.hpp>
#include <abut/convex/pairs/core_pair2.hpp>
#include <abut/convex/pairs/placed_polygon2.hpp>
#include <abut/math/assert.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/overlaps.hpp>

namespace abut::detail {
namespace {

/// Corners in the world, counter-clockwise; some may coincide or be collinear.
struct ClippedLoop {
    std::array<DVec<2>, std::size_t{2} * max_soa_edges> points;
    std::size_t count = 0;
};

/// A polygon with a smaller part of its bounding box has so sharp corners that the rounding of a line moves them by
/// more than the tolerance.
constexpr double min_area_ratio = 1e-3;

struct PlanarLoop {
    double x[2 * max_soa_edges], y[2 * max_soa_edges];
    std::size_t count = 0;

    void push_back(double at_x, double at_y) {
        x[count] = at_x;
        y[count++] = at_y;
    }
};

/// Removes the part in front of a line. Each cut of a convex loop adds at most one corner.
void cut(const PlanarLoop& from, const double* heights, double tolerance, PlanarLoop& to) {
    to.count = 0;
    for (std::size_t i = 0; i < from.count; ++i) {
        const std::size_t j = i + 1 == from.count ? 0 : i + 1;
        const double here = heights[i], there = heights[j];
        if (here <= tolerance && to.count < std::size(to.x)) to.push_back(from.x[i], from.y[i]);
        const bool crosses = (here > tolerance && there < -tolerance) || (here < -tolerance && there > tolerance);
        if (!crosses || to.count == std::size(to.x)) continue;
        const double part = here / (here - there);
        to.push_back(from.x[i] + (from.x[j] - from.x[i]) * part, from.y[i] + (from.y[j] - from.y[i]) * part);
    }
}

/// Both have rows. Returns false if one of them has almost no area, which takes the general algorithm. Corners of the
/// polygon that is cut stay in place; a corner within rounding of a line lies on it.
bool clip_polygons(const PlacedPolygon& a, const PlacedPolygon& b, ClippedLoop& loop) {
    const std::uint32_t of = b.sides.size() < a.sides.size() ? 1 : 0;  // the one that is cut
    const PolygonSoa &body = of == 0 ? a.sides : b.sides, &tool = of == 0 ? b.sides : a.sides;
    for (const PolygonSoa* sides : {&body, &tool})
        if (sides->count < 3 || !(sides->area() > min_area_ratio * sides->size() * sides->size())) return false;
    CorePair<PolygonCore> pair(a, b);
    pair.set_relative_places();
    const Rigid2 seen = rigid(pair.seen_from(of));
    const double tolerance =
        0x1p-47 * (std::abs(seen.x) + std::abs(seen.y) + 2 * (body.size() + tool.size()) + std::abs(body.x(0)) +
                   std::abs(body.y(0)) + std::abs(tool.x(0)) + std::abs(tool.y(0)));
    PlanarLoop loops[2];
    PlanarLoop *now = &loops[0], *next = &loops[1];
    for (std::uint32_t i = 0; i < body.count; ++i) now->push_back(body.x(i), body.y(i));
    for (std::uint32_t side = 0; side < tool.count && now->count > 0; ++side) {
        const DVec<2> normal = seen.vector(tool.normal(side));
        const double offset = tool.offset(side) + (normal.x * seen.x + normal.y * seen.y);
        double heights[2 * max_soa_edges], highest = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < now->count; ++i) {
            heights[i] = (normal.x * now->x[i] + normal.y * now->y[i]) - offset;
            highest = heights[i] > highest ? heights[i] : highest;
        }
        if (highest <= tolerance) continue;
        cut(*now, heights, tolerance, *next);
        std::swap(now, next);
    }
    const Rigid2 place = rigid((of == 0 ? a : b).place);
    loop.count = now->count;
    for (std::size_t i = 0; i < now->count; ++i) loop.points[i] = place.point(DVec<2>(now->x[i], now->y[i]));
    return true;
}

}  // namespace
}  // namespace abut::detail

namespace abut {

using namespace detail;

namespace {

template <int D>
bool has_float_corners(const Convex<D>& convex) {
    if (!detail::has_corners_only(convex) || !is_finite(convex)) return false;
    const Aabb<D> box = bounds(convex);
    return is_finite<D>(box.min) && is_finite<D>(box.max);
}

template <int D>
bool convex_intersection(const Convex<D>& a, const Convex<D>& b, PolytopeOf<D>& out, const QueryOptions<D>& options) {
    const bool possible = has_float_corners(a) && has_float_corners(b);
    ABUT_ASSERT(possible);
    if (!possible || !overlaps(View<D>(a), View<D>(b), {.cache = options.cache})) return false;

    std::vector<DVec<D>> points = clip(a, b, options.trace);
    if (points.empty()) {
        // They touch for one algorithm and miss by a rounding for the other.
        const SignedDistance<D> touch = signed_distance(a, b);
        points.push_back(0.5 * (touch.on_a + touch.on_b()));
    }
    std::vector<Vec<D>> rounded;
    for (const DVec<D>& point : points) rounded.push_back(to_float(point));
    out = *PolytopeOf<D>::build(rounded);
    return true;
}

/// Rounds to floats, starting at the lexicographically least corner; -0 becomes 0.
void round_loop(const ClippedLoop& loop, std::array<Vec2, 2 * max_soa_edges>& rounded) {
    const auto less = [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
    std::size_t first = 0;
    std::array<Vec2, 2 * max_soa_edges> corners;
    for (std::size_t i = 0; i < loop.count; ++i) {
        corners[i] = to_float(loop.points[i]) + Vec2(0);
        if (less(corners[i], corners[first])) first = i;
    }
    for (std::size_t i = 0; i < loop.count; ++i)
        rounded[i] = corners[first + i < loop.count ? first + i : first + i - loop.count];
}

/// The fast path for polygons of few edges that overlap by more than rounding. False means unknown.
bool fast_intersection(const Convex<2>& a, const Convex<2>& b, Polygon& out) {
    if (a.radius > 0 || b.radius > 0 || !is_finite(a) || !is_finite(b)) return false;
    PlacedPolygon polygon_a, polygon_b;
    if (!set_placed_polygon(a, polygon_a) || !set_placed_polygon(b, polygon_b)) return false;
    double scale = 0;
    for (PlacedPolygon* polygon : {&polygon_a, &polygon_b}) {
        polygon->make_rows();
        const PolygonSoa& sides = polygon->sides;
        scale = std::max({scale, largest(vector_of(polygon->place.position)), sides.size(), std::abs(sides.x(0)),
                          std::abs(sides.y(0))});
    }
    ClippedLoop loop;
    if (!(scale < 1e37) || !clip_polygons(polygon_a, polygon_b, loop)) return false;
    std::array<Vec2, 2 * max_soa_edges> rounded;
    round_loop(loop, rounded);
    // An overlap this thin could be a gap before rounding to floats; the robust path decides.
    return out.set_outline(std::span(rounded.data(), loop.count), 1e-6 * scale);
}

}  // namespace

bool intersection(const Convex<2>& a, const Convex<2>& b, Polygon& out, const QueryOptions<2>& options) {
    if (options.trace != nullptr) {
        // The fast path has no steps to record, and a trace changes no answer.
        Polygon traced;
        convex_intersection(a, b, traced, options);
    }
    if (fast_intersection(a, b, out)) return true;
    return convex_intersection(a, b, out, {.cache = options.cache});
}

bool intersection(const Convex<3>& a, const Convex<3>& b, Polyhedron& out, const QueryOptions<3>& options) {
    return convex_intersection(a, b, out, options);
}

}  // namespace abut
