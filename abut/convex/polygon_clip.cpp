// After Sutherland and Hodgman, "Reentrant polygon clipping" (1974).

#include <abut/convex/polygon_clip.hpp>

namespace abut {
namespace {

/// A polygon with less of its box than this comes to points so sharp that doubt about a line is more than doubt about
/// a corner.
constexpr double least_part = 1e-3;

struct Loop {
    double x[2 * most_sides], y[2 * most_sides];
    std::size_t count = 0;

    void push_back(double at_x, double at_y) {
        x[count] = at_x;
        y[count++] = at_y;
    }
};

/// Keeps what is behind a line. Each cut of a convex loop adds one corner at most.
void cut(const Loop& from, const double* heights, double doubt, Loop& to) {
    to.count = 0;
    for (std::size_t i = 0; i < from.count; ++i) {
        const std::size_t j = i + 1 == from.count ? 0 : i + 1;
        const double here = heights[i], there = heights[j];
        if (here <= doubt && to.count < std::size(to.x)) to.push_back(from.x[i], from.y[i]);
        const bool crosses = (here > doubt && there < -doubt) || (here < -doubt && there > doubt);
        if (!crosses || to.count == std::size(to.x)) continue;
        const double part = here / (here - there);
        to.push_back(from.x[i] + (from.x[j] - from.x[i]) * part, from.y[i] + (from.y[j] - from.y[i]) * part);
    }
}

}  // namespace

bool clip_polygons(const PolygonPair& pair, ClippedLoop& loop) {
    const std::uint32_t of = pair.sides(1).size < pair.sides(0).size ? 1 : 0;  // the one that is cut
    const Sides &body = pair.sides(of), &tool = pair.sides(1 - of);
    for (const Sides* sides : {&body, &tool})
        if (sides->count < 3 || !(sides->area > least_part * sides->size * sides->size)) return false;
    const Rigid2& seen = pair.seen_from(of);
    const double doubt =
        0x1p-47 * (std::abs(seen.x) + std::abs(seen.y) + 2 * (body.size + tool.size) + std::abs(body.x[0]) +
                   std::abs(body.y[0]) + std::abs(tool.x[0]) + std::abs(tool.y[0]));
    Loop loops[2];
    Loop *now = &loops[0], *next = &loops[1];
    for (std::uint32_t i = 0; i < body.count; ++i) now->push_back(body.x[i], body.y[i]);
    for (std::uint32_t side = 0; side < tool.count && now->count > 0; ++side) {
        const DVec<2> normal = seen.vector(tool.normal(side));
        const double offset = tool.offset[side] + (normal.x * seen.x + normal.y * seen.y);
        double heights[2 * most_sides], highest = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < now->count; ++i) {
            heights[i] = (normal.x * now->x[i] + normal.y * now->y[i]) - offset;
            highest = heights[i] > highest ? heights[i] : highest;
        }
        if (highest <= doubt) continue;
        cut(*now, heights, doubt, *next);
        std::swap(now, next);
    }
    const Rigid2& place = pair.outline(of).place;
    loop.count = now->count;
    for (std::size_t i = 0; i < now->count; ++i) loop.points[i] = place.point(DVec<2>(now->x[i], now->y[i]));
    return true;
}

}  // namespace abut
