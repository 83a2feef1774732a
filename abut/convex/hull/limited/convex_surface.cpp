#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/limited/convex_surface.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <limits>

namespace abut::detail {

std::optional<ConvexSurface> convex_surface(std::span<const DVec<3>> points, double tolerance) {
    const HullGrid grid = on_grid(points);
    const Spread spread = spread_of(grid, grid.tolerance);
    if (spread.rank < 3) return std::nullopt;
    ConvexSurface result{{}, quickhull(grid.points, spread.points, grid.tolerance * (tolerance / hull_tolerance))};
    result.points = points_in_use(points, result.triangles.origin);
    return result;
}

const DVec<3>& SupportSearch::highest(const DVec<3>& direction) {
    double max_height = -std::numeric_limits<double>::infinity();
    at_ = hill_climb_.best(at_, [&](std::uint32_t i) {
        const double height = dot(direction, points_[i]);
        if (!(height > max_height)) return false;
        max_height = height;
        return true;
    });
    return points_[at_];
}

const DVec<3>& SupportSearch::first_touched(const DVec<3>& from, const DVec<3>& on, const DVec<3>& normal,
                                            double near) {
    // Seen along the line; the plane begins upside down.
    double best_x = -1, best_y = 1e-9;
    at_ = hill_climb_.best(at_, [&](std::uint32_t i) {
        const DVec<3> seen = points_[i] - from;
        const double x = dot(on, seen), y = std::max(0.0, -dot(normal, seen));
        if (!(x * best_y - y * best_x > 0) || x * x + y * y <= near * near) return false;
        best_x = x;
        best_y = y;
        return true;
    });
    return points_[at_];
}

}  // namespace abut::detail
