#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/manifold/clip.hpp>
#include <abut/convex/manifold/polygon_clip.hpp>
#include <abut/math/assert.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/overlaps.hpp>

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
