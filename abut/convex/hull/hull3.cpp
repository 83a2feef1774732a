// The hull in 3D: the rank of the points, quickhull for rank 3, and the result in floats.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/hull_faces.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/hull_planes.hpp>
#include <abut/convex/hull/interior_filter.hpp>
#include <abut/convex/hull/quickhull.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace abut::detail {
namespace {

std::vector<Vec3> sorted_without_copies(std::span<const Vec3> points) {
    std::vector<Vec3> result = without_interior_points(points);
    for (Vec3& point : result) point = without_negative_zero(point);
    std::sort(result.begin(), result.end(), [](const Vec3& a, const Vec3& b) { return less(a, b); });
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

/// The hull of coplanar points, to within the tolerance: their 2D hull along the axis closest to the normal, as two
/// faces, back to back.
HullFaces flat_faces(std::span<const Vec3> points, const DVec<3>& normal) {
    const DVec<3> steep{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int up = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
    std::vector<Vec2> outline;
    outline.reserve(points.size());
    for (const Vec3& point : points) outline.emplace_back(point[(up + 1) % 3], point[(up + 2) % 3]);
    std::vector<std::uint32_t> loop = hull_loop(outline);

    DVec<3> area(0.0);
    const DVec<3> origin(points[loop[0]]);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        area += cross(DVec<3>(points[loop[i]]) - origin, DVec<3>(points[loop[i + 1]]) - origin);
    HullFaces result;
    result.normals = {to_float(normalized(area)), to_float(-normalized(area))};
    result.loops = loop;
    result.loops.insert(result.loops.end(), loop.rbegin(), loop.rend());
    const auto corners = static_cast<std::uint32_t>(loop.size());
    result.loop_ends = {corners, 2 * corners};
    return result;
}

/// The smallest offset of a plane with this normal that no point is above.
double offset_across(const Vec3& normal, std::span<const Vec3> points) {
    const auto along = [&](const Vec3& point) { return dot(DVec<3>(normal), DVec<3>(point)); };
    double result = along(points[0]);
    for (const Vec3& point : points) result = std::max(result, along(point));
    return result;
}

/// Volume, area and centroid, from triangles that cover the surface (three corners each). The triangles are exact;
/// merged faces aren't quite flat, which would change the volume of a thin body.
void measure(Hull3& hull, const HullGrid& grid, std::span<const std::uint32_t> triangles) {
    const GridPoint& origin = grid.points[triangles[0]];
    const auto seen = [&](std::size_t i) { return grid.points[triangles[i]] - origin; };
    // The centroid of the tetrahedron with the origin is (a + b + c) / 4, that of the triangle (a + b + c) / 3.
    double volume = 0, area = 0;
    DVec<3> by_volume(0.0), by_area(0.0);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const GridPoint a = seen(i), b = seen(i + 1), c = seen(i + 2), normal = grid_normal(a, b, c);
        const double part = grid_dot(normal, a), face = length(DVec<3>(normal));  // the part is never below 0
        volume += part;
        by_volume += part * DVec<3>(a + b + c);
        area += face;
        by_area += face * DVec<3>(a + b + c);
    }
    const DVec<3> center = hull.rank == 3 ? by_volume / (4 * volume) : by_area / (3 * area);
    hull.centroid = to_float(grid.least + (DVec<3>(origin) + center) * grid.step);
    hull.volume = hull.rank == 3 ? volume / 6 * grid.step * grid.step * grid.step : 0;
    hull.area = area / 2 * grid.step * grid.step;
}

std::vector<std::uint32_t> triangles_of(const HullFaces& faces) {
    std::vector<std::uint32_t> result;
    for (std::size_t face = 0; face < faces.normals.size(); ++face) {
        const std::span<const std::uint32_t> loop = faces.loop(face);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i) result.insert(result.end(), {loop[0], loop[i], loop[i + 1]});
    }
    return result;
}

/// For points that aren't collinear.
Hull3 hull_with_faces(std::span<const Vec3> points, const HullGrid& grid, const Spread& spread) {
    Hull3 result;
    result.rank = spread.rank;
    if (spread.rank == 2) {
        const auto& [a, b, c, d] = spread.points;
        const HullFaces flat = flat_faces(points, DVec<3>(grid_normal(grid.points[a], grid.points[b], grid.points[c])));
        measure(result, grid, triangles_of(flat));
        HullFaces faces = in_order(flat, points.size());
        for (const Vec3& normal : faces.normals) result.offsets.push_back(offset_across(normal, points));
        take_faces(result, points, std::move(faces));
        return result;
    }
    const TriangleSurface surface = quickhull(grid.points, spread.points, grid.tolerance);
    measure(result, grid, surface.origin);
    HullFaces faces = in_order(hull_faces(grid.points, surface, grid.tolerance, grid.flatness), points.size());
    result.offsets = plane_offsets(faces, points, grid, surface);
    take_faces(result, points, std::move(faces));
    return result;
}

}  // namespace

Result<Hull3> hull(std::span<const Vec3> points) {
    if (auto problem = problem_with(points)) return *problem;
    const std::vector<Vec3> sorted = sorted_without_copies(points);
    Hull3 result;
    if (sorted.size() > 1) {
        const HullGrid grid = on_grid(sorted);
        const Spread spread = spread_of(grid, grid.tolerance);
        if (spread.rank > 1) return hull_with_faces(sorted, grid, spread);
        const auto [low, high] = std::minmax(spread.points[0], spread.points[1]);
        result.points = {sorted[low], sorted[high]};
        result.rank = 1;
    } else {
        result.points = sorted;
    }
    result.centroid = to_float(0.5 * (DVec<3>(result.points.front()) + DVec<3>(result.points.back())));
    return result;
}

}  // namespace abut::detail
