// A hull of few corners in space.

#include <abut/convex/hull_input.hpp>
#include <abut/convex/limited_hull.hpp>
#include <abut/convex/outer_mesh.hpp>
#include <abut/convex/round_out.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace abut {
namespace {

constexpr int tightening_rounds = 8, most_margins = 24;

using Triangles = std::vector<std::array<Vec3, 3>>;

/// Whether a closed surface, wound outwards, surely has the points in the convex hull of its corners: none is above a
/// triangle. Then the surface goes around each of them, as all its triangles are seen from their inner sides.
bool surely_holds(const Triangles& triangles, std::span<const Vec3> points) {
    for (const auto& [a, b, c] : triangles) {
        const DVec<3> origin(a), u = DVec<3>(b) - origin, v = DVec<3>(c) - origin, normal = cross(u, v);
        const double doubt = 1e-14 * length(u) * length(v);
        for (const Vec3& point : points) {
            const DVec<3> seen = DVec<3>(point) - origin;
            if (dot(normal, seen) < -doubt * length(seen)) continue;
            if (orientation(a, b, c, point) > 0) return false;
        }
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

/// The corners of the mesh, which are seen from `origin`, as floats: outside of the planes of their triangles by
/// `margin`, after these were moved out to the points that they leave out. Nothing where one leaves the range of
/// floats.
std::optional<std::vector<Vec3>> rounded_corners(const OuterMesh& mesh, const DVec<3>& origin,
                                                 std::span<const DVec<3>> inside, double margin) {
    std::vector<Plane<3>> planes(mesh.triangle_count());
    for (std::uint32_t triangle = 0; triangle < planes.size(); ++triangle) {
        if (!mesh.has_triangle(triangle)) continue;
        Plane<3>& plane = planes[triangle];
        plane = mesh.plane(triangle);
        for (const DVec<3>& point : inside) plane.offset = std::max(plane.offset, dot(plane.normal, point));
        plane.offset += margin + dot(plane.normal, origin);
    }
    std::vector<Vec3> result(mesh.points().size());
    std::vector<Plane<3>> around;
    for (std::uint32_t point = 0; point < result.size(); ++point) {
        if (!mesh.has_point(point)) continue;
        around.clear();
        mesh.each_triangle_around(point, [&](std::uint32_t triangle) { around.push_back(planes[triangle]); });
        const std::optional<Vec3> corner = rounded_out<3>(mesh.points()[point] + origin, around);
        if (!corner) return std::nullopt;
        result[point] = *corner;
    }
    return result;
}

/// The hull of the mesh's corners, rounded to floats no farther out than it takes to hold the points.
std::optional<Hull3> rounded_hull(const OuterMesh& mesh, const DVec<3>& origin, std::span<const Vec3> points,
                                  std::span<const DVec<3>> seen, double extent) {
    double margin = 0;
    for (int i = 0; i < most_margins; ++i) {
        const std::optional<std::vector<Vec3>> corners = rounded_corners(mesh, origin, seen, margin);
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
        margin = margin == 0 ? 0x1p-24 * extent : 2 * margin;
    }
    return std::nullopt;
}

/// The hull of `count` of the corners of a solid one, by the farthest from what is there first.
Hull3 hull_of_some(const Hull3& all, std::size_t count) {
    std::vector<Vec3> chosen{all.points.front(), all.points.back()};
    for (;;) {
        Hull3 result = *hull(chosen);
        if (chosen.size() >= count) return result;
        double farthest = -1;
        Vec3 next = chosen[0];
        for (const Vec3& point : all.points) {
            const DVec<3> p(point);
            double distance = 0;
            if (result.rank == 3) {
                for (std::size_t face = 0; face < result.normals.size(); ++face)
                    distance = std::max(distance, dot(DVec<3>(result.normals[face]), p) - result.offsets[face]);
            } else if (result.rank == 2) {
                distance = std::abs(dot(DVec<3>(result.normals[0]), p) - result.offsets[0]);
            } else {
                distance = length(cross(p - DVec<3>(chosen[0]), DVec<3>(chosen[1]) - DVec<3>(chosen[0])));
            }
            if (distance > farthest) {
                farthest = distance;
                next = point;
            }
        }
        chosen.push_back(next);
    }
}

Problem out_of_range() {
    return {ProblemCode::too_large, "so few corners that hold all points are beyond the range of floats", 0};
}

/// Around the points from fewer corners of their own than the mesh has, which then grow until they hold all.
OuterMesh grown(const Hull3& full, std::size_t limit, const DVec<3>& origin, std::span<const DVec<3>> inside) {
    const Hull3 some = hull_of_some(full, limit);
    const DVec<3> middle(some.centroid);
    OuterMesh result(some, middle);
    double factor = 1;
    for (std::uint32_t triangle = 0; triangle < result.triangle_count(); ++triangle) {
        const Plane<3>& plane = result.plane(triangle);
        for (const DVec<3>& point : inside)
            factor = std::max(factor, dot(plane.normal, point + (origin - middle)) / plane.offset);
    }
    result.scale(factor, origin - middle);
    return result;
}

Result<Hull3> limited_solid(const Hull3& full, std::span<const Vec3> points, std::size_t limit) {
    const DVec<3> origin(full.centroid);
    std::vector<DVec<3>> seen, corners;
    seen.reserve(points.size());
    for (const Vec3& point : points) seen.push_back(DVec<3>(point) - origin);
    for (const Vec3& point : full.points) corners.push_back(DVec<3>(point) - origin);
    OuterMesh mesh(full, origin);
    mesh.simplify(limit);
    if (mesh.count() > limit) mesh = grown(full, limit, origin, corners);
    mesh.tighten(corners, tightening_rounds);
    const std::optional<Hull3> result = rounded_hull(mesh, origin, points, seen, extent<3>(points));
    if (!result || result->points.size() > limit) return out_of_range();
    return *result;
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
    Result<Hull3> result = limited_solid(*full, points, options.max_vertices);
    if (result && options.added != nullptr) *options.added = result->volume - full->volume;
    return result;
}

}  // namespace abut
