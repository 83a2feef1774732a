// A hull of few corners in space.

#include <abut/convex/hull_input.hpp>
#include <abut/convex/inner_hull.hpp>
#include <abut/convex/limited_hull.hpp>
#include <abut/convex/outer_mesh.hpp>
#include <abut/convex/round_out.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/linear.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace abut {
namespace {

constexpr std::size_t few_corners = 32, pool_corners = 4, least_pool = 64;
// Where the body reaches about 0.45 from its middle: how deep a point is surely inside, and how near no plane comes.
constexpr double depth_for_sure = 1e-4, least_offset = 1e-3;
constexpr int tightening_rounds = 8, most_margins = 24;

using Triangles = std::vector<std::array<Vec3, 3>>;

/// Whether a closed surface, wound outwards, surely has the points in the convex hull of its corners: none is above a
/// triangle. Then the surface goes around each of them, as all its triangles are seen from their inner sides.
bool surely_holds(const Triangles& triangles, std::span<const Vec3> points) {
    if (points.empty()) return true;
    const DVec<3> low = least_corner<3>(points), high = greatest_corner<3>(points);
    for (const auto& [a, b, c] : triangles) {
        const DVec<3> origin(a), u = DVec<3>(b) - origin, v = DVec<3>(c) - origin, normal = cross(u, v);
        const double doubt = 1e-14 * length(u) * length(v) * (length(low - origin) + length(high - low));
        for (const Vec3& point : points)
            if (!(dot(normal, DVec<3>(point) - origin) < -doubt) && orientation(a, b, c, point) > 0) return false;
    }
    return true;
}

Triangles triangles_of(const Hull3& hull) {
    Triangles result;
    std::size_t begin = 0;
    for (const std::uint32_t end : hull.loop_ends) {
        for (std::size_t i = begin + 1; i + 1 < end; ++i)
            result.push_back(
                {hull.points[hull.loops[begin]], hull.points[hull.loops[i]], hull.points[hull.loops[i + 1]]});
        begin = end;
    }
    return result;
}

Triangles triangles_of(const OuterMesh& mesh, std::span<const Vec3> corners) {
    Triangles result;
    for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle)
        if (mesh.has_triangle(triangle))
            result.push_back({corners[mesh.corner(triangle, 0)], corners[mesh.corner(triangle, 1)],
                              corners[mesh.corner(triangle, 2)]});
    return result;
}

/// Takes what is round to the hull: seen the other way, its volume reaches equally far in all directions.
Affine<3> from_round(const Hull3& hull) {
    const DVec<3> origin(hull.centroid);
    DVec<3> diagonal(0.0), off(0.0);  // of the sum of p p^T over its volume: xx, yy, zz and yz, zx, xy
    const auto add = [&](const DVec<3>& p, double weight) {
        diagonal += DVec<3>(p.x * p.x, p.y * p.y, p.z * p.z) * weight;
        off += DVec<3>(p.y * p.z, p.z * p.x, p.x * p.y) * weight;
    };
    double volume = 0;
    for (const auto& [a, b, c] : triangles_of(hull)) {
        const DVec<3> u = DVec<3>(a) - origin, v = DVec<3>(b) - origin, w = DVec<3>(c) - origin;
        const double part = dot(cross(u, v), w);
        volume += part;
        for (const DVec<3>& p : {u, v, w, u + v + w}) add(p, part);
    }
    // The root of that, by Cholesky.
    diagonal /= volume;
    off /= volume;
    const double least = 1e-15 * largest(diagonal);
    const double xx = std::sqrt(std::max(diagonal.x, least)), xy = off.z / xx, xz = off.y / xx;
    const double yy = std::sqrt(std::max(diagonal.y - xy * xy, least)), yz = (off.x - xy * xz) / yy;
    const double zz = std::sqrt(std::max(diagonal.z - xz * xz - yz * yz, least));
    Affine<3> result;
    result.column = {DVec<3>(xx, xy, xz), DVec<3>(0, yy, yz), DVec<3>(0, 0, zz)};
    result.offset = origin;
    return result;
}

/// The corners of the mesh, which `map` takes to the world, as floats: outside of the planes of their triangles by
/// `margin`, after these were moved out to the points that they leave out. Nothing where one leaves the range of
/// floats.
std::optional<std::vector<Vec3>> rounded_corners(const OuterMesh& mesh, const Affine<3>& map,
                                                 std::span<const Vec3> points, double margin) {
    const Affine<3> back = inverse(map, determinant(map));
    std::vector<Plane<3>> planes(mesh.triangle_count());
    for (std::uint32_t triangle = 0; triangle < planes.size(); ++triangle) {
        if (!mesh.has_triangle(triangle)) continue;
        const Plane<3>& seen = mesh.plane(triangle);
        const DVec<3> normal = back.transposed(seen.normal);
        const double inverse_length = 1 / length(normal);
        Plane<3>& plane = planes[triangle];
        plane = {normal * inverse_length, (seen.offset - dot(seen.normal, back.offset)) * inverse_length};
        for (const Vec3& point : points) plane.offset = std::max(plane.offset, dot(plane.normal, DVec<3>(point)));
        plane.offset += margin;
    }
    std::vector<Vec3> result(mesh.points().size());
    std::vector<Plane<3>> around;
    for (std::uint32_t point = 0; point < result.size(); ++point) {
        if (!mesh.has_point(point)) continue;
        around.clear();
        mesh.each_triangle_around(point, [&](std::uint32_t triangle) { around.push_back(planes[triangle]); });
        const std::optional<Vec3> corner = rounded_out<3>(map.point(mesh.points()[point]), around);
        if (!corner) return std::nullopt;
        result[point] = *corner;
    }
    return result;
}

/// The hull of the mesh's corners, rounded to floats no farther out than it takes to hold the points.
std::optional<Hull3> rounded_hull(const OuterMesh& mesh, const Affine<3>& map, std::span<const Vec3> points,
                                  double side) {
    double margin = 0;
    for (int i = 0; i < most_margins; ++i) {
        const std::optional<std::vector<Vec3>> corners = rounded_corners(mesh, map, points, margin);
        if (!corners) return std::nullopt;
        std::vector<Vec3> used;
        for (std::uint32_t point = 0; point < corners->size(); ++point)
            if (mesh.has_point(point)) used.push_back((*corners)[point]);
        Hull3 result = *hull(used);
        if (result.rank == 3) {
            const Triangles surface = triangles_of(result);
            std::erase_if(used, [&](const Vec3& corner) {
                return std::binary_search(result.points.begin(), result.points.end(), corner,
                                          [](const Vec3& a, const Vec3& b) { return less(a, b); });
            });
            const bool lost_nothing = surely_holds(surface, used);
            if ((lost_nothing && surely_holds(triangles_of(mesh, *corners), points)) || surely_holds(surface, points))
                return result;
        }
        margin = margin == 0 ? 0x1p-24 * side : 2 * margin;
    }
    return std::nullopt;
}

/// The corners where planes around the origin meet. They are the planes of a hull, that of the points at 1 / offset
/// along their normals.
std::vector<Vec3> corners_of_planes(const Hull3& polar) {
    std::vector<Vec3> result;
    for (std::size_t face = 0; face < polar.normals.size(); ++face)
        if (polar.offsets[face] > least_offset)
            result.push_back(to_float(DVec<3>(polar.normals[face]) / polar.offsets[face]));
    return result;
}

/// The least of several meshes of so few corners around all that is inside, seen from its middle. Nothing where
/// rounding undid them all.
std::optional<OuterMesh> least_mesh(OuterMesh mesh, const InnerPoints& inside, std::size_t limit) {
    std::optional<OuterMesh> result;
    double least = 0;
    const auto offer = [&](OuterMesh& offered) {
        if (offered.count() > limit) return;
        offered.tighten(inside, tightening_rounds);
        const double volume = offered.volume();
        if (!offered.holds(inside) || (result && !(volume < least))) return;
        result = offered;
        least = volume;
    };
    const auto offer_grown = [&](const Hull3& inner) {
        if (inner.rank < 3) return;
        OuterMesh grown(inner, Affine<3>());
        grown.grow(DVec<3>(inner.centroid), inside);
        offer(grown);
    };

    mesh.simplify(std::max(pool_corners * limit, least_pool));
    std::vector<Vec3> polar;
    for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle)
        if (mesh.has_triangle(triangle) && mesh.plane(triangle).offset > least_offset)
            polar.push_back(to_float(mesh.plane(triangle).normal / mesh.plane(triangle).offset));
    mesh.simplify(limit);
    offer(mesh);
    if (result && limit > few_corners) return result;

    std::vector<Vec3> points;
    for (const DVec<3>& point : inside.points()) points.push_back(to_float(point));
    offer_grown(inner_hull(points, limit));
    if (polar.size() < 4) return result;
    const std::vector<Vec3> corners = corners_of_planes(inner_hull(polar, limit / 2 + 2));
    if (corners.size() >= 4) offer_grown(*hull(corners));
    return result;
}

/// Larger than it needs to be.
std::optional<Hull3> hull_of_box(std::span<const Vec3> points, std::size_t limit) {
    const std::vector<Vec3> corners = corners_of_box<3>(points, limit);
    if (corners.empty()) return std::nullopt;
    Hull3 result = *hull(corners);
    if (result.rank < 3 || !surely_holds(triangles_of(result), points)) return std::nullopt;
    return result;
}

/// The points that aren't far inside of the mesh.
std::vector<Vec3> near_surface(const OuterMesh& mesh, const Affine<3>& seen_by, std::span<const Vec3> points) {
    std::vector<Plane<3>> planes;
    for (std::uint32_t triangle = 0; triangle < mesh.triangle_count(); ++triangle)
        if (mesh.has_triangle(triangle)) planes.push_back(mesh.plane(triangle));
    std::vector<Vec3> result;
    for (const Vec3& point : points) {
        const DVec<3> seen = seen_by.point(DVec<3>(point));
        for (const Plane<3>& plane : planes) {
            if (!(dot(plane.normal, seen) > plane.offset - depth_for_sure)) continue;
            result.push_back(point);
            break;
        }
    }
    return result;
}

Result<Hull3> limited_solid(const Hull3& full, std::span<const Vec3> points, std::size_t limit) {
    const Affine<3> map = from_round(full), seen_by = inverse(map, determinant(map));
    const std::optional<OuterMesh> mesh = least_mesh(OuterMesh(full, seen_by), InnerPoints(full, seen_by), limit);
    std::optional<Hull3> result;
    if (mesh) result = rounded_hull(*mesh, map, near_surface(*mesh, seen_by, points), extent<3>(full.points));
    if (!result) result = hull_of_box(points, limit);
    if (!result) return beyond_floats();
    return *std::move(result);
}

/// In its plane: the outline as seen along the axis nearest to the normal, with corners of its own that are put back
/// into the plane.
Result<Hull3> limited_flat(const Hull3& full, std::span<const Vec3> points, std::size_t limit) {
    const DVec<3> normal(full.normals[0]);
    const double middle = 0.5 * (full.offsets[0] - full.offsets[1]);
    const DVec<3> steep{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    const int up = steep.x >= steep.y && steep.x >= steep.z ? 0 : (steep.y >= steep.z ? 1 : 2);
    const int right = (up + 1) % 3, front = (up + 2) % 3;
    const auto shadow = [&](const Vec3& point) { return Vec2(point[right], point[front]); };
    const bool level =
        std::all_of(points.begin(), points.end(), [&](const Vec3& point) { return point[up] == points[0][up]; });
    const auto lifted = [&](const Vec2& point) {
        Vec3 result;
        result[right] = point.x;
        result[front] = point.y;
        const double rest = normal[right] * static_cast<double>(point.x) + normal[front] * static_cast<double>(point.y);
        result[up] = level ? points[0][up] : static_cast<float>((middle - rest) / normal[up]);
        return result;
    };
    std::vector<Vec2> outline;
    for (const Vec3& point : points) outline.push_back(shadow(point));
    const std::vector<std::uint32_t> loop = hull_loop(outline);
    std::vector<Vec2> inner;
    for (const std::uint32_t i : loop) inner.push_back(outline[i]);

    std::optional<Hull3> result;
    outline_of(inner, limit, [&](const Hull2& outer) {
        std::vector<Vec3> corners;
        for (const Vec2& corner : outer.points) corners.push_back(lifted(corner));
        if (!std::all_of(corners.begin(), corners.end(), [](const Vec3& corner) { return is_finite(corner); }))
            return false;
        Result<Hull3> built = hull(corners);
        if (!built || built->points.size() < corners.size()) return false;
        result = *std::move(built);
        return true;
    });
    if (!result) return beyond_floats();
    return *std::move(result);
}

}  // namespace

Result<Hull3> limited_hull(std::span<const Vec3> points, const HullOptions& options) {
    if (options.added != nullptr) *options.added = 0;
    if (options.max_vertices != 0 && options.max_vertices < 4)
        return Problem{
            ProblemCode::bad_argument,
            "max_vertices is " + std::to_string(options.max_vertices) + ", and a solid has 4 corners or more", 0};
    Result<Hull3> full = hull(points);
    if (!full || options.max_vertices == 0 || full->points.size() <= options.max_vertices) return full;
    const bool flat = full->rank == 2;
    Result<Hull3> result =
        flat ? limited_flat(*full, points, options.max_vertices) : limited_solid(*full, points, options.max_vertices);
    if (result && options.added != nullptr)
        *options.added = flat ? result->area - full->area : result->volume - full->volume;
    return result;
}

}  // namespace abut
