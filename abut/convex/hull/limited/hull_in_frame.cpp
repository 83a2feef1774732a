#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/convex/hull/hull_grid.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/limited/hull_in_frame.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

/// Calls visit(a, b, c) for the corners of each triangle.
template <class Visit>
void each_triangle(std::span<const Vec3> corners, const TriangleSurface& surface, Visit visit) {
    for (std::size_t h = 0; h < surface.origin.size(); h += 3)
        visit(corners[surface.origin[h]], corners[surface.origin[h + 1]], corners[surface.origin[h + 2]]);
}

/// Whether all points lie in the hull of a closed surface with outward winding: none is above a triangle.
bool holds(std::span<const Vec3> corners, const TriangleSurface& surface, std::span<const Vec3> points) {
    const DVec<3> low = min_corner<3>(points), high = max_corner<3>(points);
    bool result = true;
    each_triangle(corners, surface, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        if (!result) return;
        const DVec<3> origin(a), u = DVec<3>(b) - origin, v = DVec<3>(c) - origin, normal = cross(u, v);
        const double surely = 1e-14 * length(u) * length(v) * (length(low - origin) + length(high - low));
        for (const Vec3& point : points)
            if (!(dot(normal, DVec<3>(point) - origin) < -surely) && orientation(a, b, c, point) > 0) {
                result = false;
                return;
            }
    });
    return result;
}

/// Volume, area and centroid. The sums are relative to a corner.
void measure(Hull3& hull, std::span<const Vec3> corners, const TriangleSurface& surface) {
    const DVec<3> origin(corners[0]);
    double six_volumes = 0, two_areas = 0;
    DVec<3> moment(0.0);
    each_triangle(corners, surface, [&](const Vec3& first, const Vec3& second, const Vec3& third) {
        const DVec<3> a = DVec<3>(first) - origin, b = DVec<3>(second) - origin, c = DVec<3>(third) - origin;
        const DVec<3> normal = cross(b - a, c - a);
        const double part = dot(normal, a);
        six_volumes += part;
        moment += (a + b + c) * part;
        two_areas += length(normal);
    });
    hull.volume = six_volumes / 6;
    hull.area = two_areas / 2;
    const DVec<3> center = six_volumes > 0 ? moment / (4 * six_volumes) : DVec<3>(0.0);
    hull.centroid = to_float(origin + center);
}

/// The unit vector area of a loop.
Vec3 normal_of(std::span<const Vec3> corners, std::span<const std::uint32_t> loop) {
    const DVec<3> origin(corners[loop[0]]);
    DVec<3> area(0.0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        area += cross(DVec<3>(corners[loop[i]]) - origin, DVec<3>(corners[loop[i + 1]]) - origin);
    return to_float(normalized(area));
}

}  // namespace

std::optional<Hull3> hull_in_frame(std::span<const Vec3> corners, std::span<const Vec3> points,
                                   const StretchedFrame<3>& frame) {
    std::vector<Vec3> sorted(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end(), [](const Vec3& a, const Vec3& b) { return less(a, b); });
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<DVec<3>> seen;
    for (const Vec3& corner : sorted) seen.push_back(frame.from_world(DVec<3>(corner)));
    const HullGrid grid = on_grid(seen);
    const Spread spread = spread_of(grid, grid.tolerance);
    if (spread.rank < 3) return std::nullopt;
    const TriangleSurface surface = quickhull(grid.points, spread.points, 0);
    if (!holds(sorted, surface, points)) return std::nullopt;

    Hull3 result;
    result.rank = 3;
    measure(result, sorted, surface);
    HullFaces faces = in_order(hull_faces(grid.points, surface, grid.tolerance, grid.flatness), sorted.size());
    for (std::size_t face = 0; face < faces.normals.size(); ++face) {
        Vec3& normal = faces.normals[face];
        normal = normal_of(sorted, faces.loop(face));
        result.offsets.push_back(std::max(offset_above(normal, sorted), offset_above(normal, points)));
    }
    take_faces(result, sorted, std::move(faces));
    return result;
}

}  // namespace abut::detail
