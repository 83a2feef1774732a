// After Sutherland and Hodgman, "Reentrant polygon clipping" (1974).

#include <abut/convex/manifold/polygon_clip.hpp>
#include <abut/convex/pairs/core_pair2.hpp>

namespace abut::detail {
namespace {

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

}  // namespace

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

}  // namespace abut::detail
