// Exact convex decomposition of polygons. The answer is the count of parts: fewer is better. Every call verifies that
// they cover the polygon.

#include "convex_plane.hpp"

#include "../../scenes/outlines.hpp"
#include <abut/bake/decompose_outline.hpp>
#include <abut/math/dvec.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace abut::bench {

using namespace detail;

double area_of(std::span<const Vec2> ring) {
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i)
        twice += cross(DVec<2>(ring[i]) - DVec<2>(ring[0]),
                       DVec<2>(ring[i + 1 == ring.size() ? 0 : i + 1]) - DVec<2>(ring[0]));
    return 0.5 * twice;
}

double count_if_covered(std::size_t count, double area, double expected) {
    if (std::abs(area - expected) > 1e-9 * expected) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(count);
}

namespace {

using scenes::Outline;

Side ours(const Outline& outline) {
    double expected = area_of(outline.ring);
    for (const std::vector<Vec2>& hole : outline.holes) expected -= std::abs(area_of(hole));
    return {"abut", [outline, expected](std::span<double> values) {
                const Result<std::vector<Polygon>> parts = decompose(outline.ring, outline.holes);
                double area = 0;
                for (const Polygon& part : *parts) area += part.area();
                values[0] = count_if_covered(parts->size(), area, expected);
            }};
}

Job job(std::vector<Side> sides) {
    return {.items = 1, .values = 1, .tolerance = std::numeric_limits<double>::infinity(), .sides = std::move(sides)};
}

Job large(const std::vector<Vec2>& ring) {
    return job({ours({ring, {}}), cgal_greene(ring)});
}

Job small(const std::vector<Vec2>& ring) {
    return job({ours({ring, {}}), cgal_greene(ring), cgal_approximate(ring), cgal_optimal(ring)});
}

Job star() {
    const std::vector<Vec2> ring = scenes::star(10'000, 0.1, 1);
    return job({ours({ring, {}}), cgal_greene(ring), cgal_approximate(ring)});
}

}  // namespace

std::vector<Bench> convex_plane_benches() {
    return {{"convex/plane/star/10000", star},
            {"convex/plane/spiky/10000", [] { return large(scenes::spiky_star(10'000, 1)); }},
            {"convex/plane/comb/10000", [] { return large(scenes::comb(2500)); }},
            {"convex/plane/plate/9604", [] { return job({ours(scenes::plate(20, 24, 1))}); }},
            {"convex/plane/star/100", [] { return small(scenes::star(100, 0.1, 1)); }},
            {"convex/plane/spiky/100", [] { return small(scenes::spiky_star(100, 1)); }},
            {"convex/plane/comb/100", [] { return small(scenes::comb(25)); }}};
}

}  // namespace abut::bench
