#include <abut/convex/bucket_sort.hpp>
#include <abut/convex/hull/hull_assembly.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

DVec<3> area_normal(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c) {
    return cross(b - a, c - a);
}
GridPoint area_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
    return grid_normal(a, b, c);
}
double height_along(const DVec<3>& normal, const DVec<3>& a) {
    return dot(normal, a);
}
double height_along(const GridPoint& normal, const GridPoint& a) {
    return grid_dot(normal, a);
}

/// seen(i) is the corner i of the triangles in steps, relative to `origin`.
template <class Seen>
void measure_around(Hull3& hull, const DVec<3>& least, const DVec<3>& origin, double step, std::size_t count,
                    Seen seen) {
    // The centroid of the tetrahedron with the origin is (a + b + c) / 4, that of the triangle (a + b + c) / 3.
    double volume = 0, area = 0;
    DVec<3> by_volume(0.0), by_area(0.0);
    for (std::size_t i = 0; i < count; i += 3) {
        const auto a = seen(i), b = seen(i + 1), c = seen(i + 2), normal = area_normal(a, b, c);
        const double part = height_along(normal, a), face = length(DVec<3>(normal));
        volume += part;
        by_volume += part * DVec<3>(a + b + c);
        area += face;
        by_area += face * DVec<3>(a + b + c);
    }
    const bool has_volume = hull.rank == 3 && volume > 0;
    const DVec<3> center = has_volume ? by_volume / (4 * volume) : by_area / (3 * area);
    hull.centroid = to_float(least + (origin + center) * step);
    hull.volume = has_volume ? volume / 6 * step * step * step : 0;
    hull.area = area / 2 * step * step;
}

}  // namespace

/// Two consecutive points identify a loop.
HullFaces in_order(const HullFaces& faces, std::size_t point_count) {
    const auto first_of = [](std::span<const std::uint32_t> loop) {
        return std::min_element(loop.begin(), loop.end());
    };
    const Buckets order = in_buckets(point_count, [&](auto visit) {
        for (std::uint32_t face = 0; face < faces.normals.size(); ++face) {
            const std::span<const std::uint32_t> loop = faces.loop(face);
            const auto first = first_of(loop), second = first + 1 == loop.end() ? loop.begin() : first + 1;
            visit(*first, std::uint64_t{*second} << 32 | face);
        }
    });
    HullFaces result;
    result.normals.reserve(faces.normals.size());
    result.loops.reserve(faces.loops.size());
    result.loop_ends.reserve(faces.normals.size());
    for (const std::uint64_t key : order.keys) {
        const auto face = static_cast<std::uint32_t>(key);
        const std::span<const std::uint32_t> loop = faces.loop(face);
        const auto first = first_of(loop);
        result.normals.push_back(faces.normals[face]);
        result.loops.insert(result.loops.end(), first, loop.end());
        result.loops.insert(result.loops.end(), loop.begin(), first);
        result.loop_ends.push_back(static_cast<std::uint32_t>(result.loops.size()));
    }
    return result;
}

void take_faces(Hull3& result, std::span<const Vec3> points, HullFaces faces) {
    result.points = points_in_use(points, faces.loops);
    result.normals = std::move(faces.normals);
    result.loops = std::move(faces.loops);
    result.loop_ends = std::move(faces.loop_ends);
    result.edges = facet_edges(result.loops, result.loop_ends);
}

void measure(Hull3& hull, const HullGrid& grid, std::span<const std::uint32_t> triangles) {
    const GridPoint& origin = grid.points[triangles[0]];
    measure_around(hull, grid.least, DVec<3>(origin), grid.step, triangles.size(),
                   [&](std::size_t i) { return grid.points[triangles[i]] - origin; });
}

void measure(Hull3& hull, std::span<const Vec3> points, std::span<const std::uint32_t> triangles) {
    const DVec<3> origin(points[triangles[0]]);
    measure_around(hull, DVec<3>(0.0), origin, 1, triangles.size(),
                   [&](std::size_t i) { return DVec<3>(points[triangles[i]]) - origin; });
}

Vec3 normal_of_loop(std::span<const Vec3> points, std::span<const std::uint32_t> loop) {
    DVec<3> area(0.0);
    const DVec<3> origin(points[loop[0]]);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        area += cross(DVec<3>(points[loop[i]]) - origin, DVec<3>(points[loop[i + 1]]) - origin);
    return to_float(normalized(area));
}

HullFaces flat_faces(std::span<const Vec3> points, const DVec<3>& normal) {
    const int up = longest_axis(normal);
    std::vector<Vec2> outline;
    outline.reserve(points.size());
    for (const Vec3& point : points) outline.emplace_back(point[(up + 1) % 3], point[(up + 2) % 3]);
    std::vector<std::uint32_t> loop = hull_loop(outline);

    const Vec3 front = normal_of_loop(points, loop);
    HullFaces result;
    result.normals = {front, -front};
    result.loops = loop;
    result.loops.insert(result.loops.end(), loop.rbegin(), loop.rend());
    const auto corners = static_cast<std::uint32_t>(loop.size());
    result.loop_ends = {corners, 2 * corners};
    return result;
}

std::vector<std::uint32_t> triangles_of(std::span<const std::uint32_t> loops,
                                        std::span<const std::uint32_t> loop_ends) {
    std::vector<std::uint32_t> result;
    std::size_t begin = 0;
    for (const std::uint32_t end : loop_ends) {
        for (std::size_t i = begin + 1; i + 1 < end; ++i)
            result.insert(result.end(), {loops[begin], loops[i], loops[i + 1]});
        begin = end;
    }
    return result;
}

Hull3 flat_hull(std::span<const Vec3> points, const DVec<3>& normal, std::span<const Vec3> inside) {
    Hull3 result;
    result.rank = 2;
    HullFaces faces = flat_faces(points, normal);
    measure(result, points, triangles_of(faces.loops, faces.loop_ends));
    faces = in_order(faces, points.size());
    for (const Vec3& across : faces.normals)
        result.offsets.push_back(std::max(offset_above(across, points), offset_above(across, inside)));
    take_faces(result, points, std::move(faces));
    return result;
}

double offset_above(const Vec3& normal, std::span<const Vec3> points) {
    const DVec<3> across(normal);
    double result = -std::numeric_limits<double>::infinity(), size = 0;
    for (const Vec3& point : points) {
        result = std::max(result, dot(across, DVec<3>(point)));
        size = std::max(size, largest(DVec<3>(point)));
    }
    const bool along_an_axis = (across.x != 0) + (across.y != 0) + (across.z != 0) == 1;
    return along_an_axis ? result : result + 0x1p-50 * size;
}

}  // namespace abut::detail
