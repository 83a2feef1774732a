#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/convex/hull/limited/convex_surface.hpp>

#include <utility>

namespace abut::detail {

std::optional<ConvexSurface> convex_surface(std::span<const DVec<3>> points, double tolerance) {
    const HullGrid grid = on_grid(points);
    const Spread spread = spread_of(grid, grid.tolerance);
    if (spread.rank < 3) return std::nullopt;
    ConvexSurface result{{}, quickhull(grid.points, spread.points, grid.tolerance * (tolerance / hull_tolerance))};
    std::vector<std::uint32_t> number(points.size(), 0);
    for (const std::uint32_t point : result.triangles.origin) number[point] = 1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (number[i] == 0) continue;
        number[i] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(points[i]);
    }
    for (std::uint32_t& point : result.triangles.origin) point = number[point];
    return result;
}

}  // namespace abut::detail
