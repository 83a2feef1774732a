// The hull in 3D: the rank of the points, quickhull for rank 3, and the result in floats.

#include <abut/convex/farthest_point.hpp>
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
#include <utility>

namespace abut::detail {
namespace {

/// For points that aren't collinear.
Hull3 hull_with_faces(std::span<const Vec3> points, const HullGrid& grid, const Spread& spread) {
    Hull3 result;
    result.rank = spread.rank;
    if (spread.rank == 2) {
        const auto& [a, b, c, d] = spread.points;
        const HullFaces flat = flat_faces(points, DVec<3>(grid_normal(grid.points[a], grid.points[b], grid.points[c])));
        measure(result, grid, triangles_of(flat.loops, flat.loop_ends));
        HullFaces faces = in_order(flat, points.size());
        for (const Vec3& normal : faces.normals) {
            const auto along = [&](const Vec3& point) { return dot(DVec<3>(normal), DVec<3>(point)); };
            result.offsets.push_back(along(points[farthest_of(points, along)]));
        }
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
    const std::vector<Vec3> sorted = sorted_without_copies(without_interior_points(points));
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
