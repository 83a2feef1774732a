#include <abut/math/detail/coincident.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/mesh/clean_up.hpp>
#include <abut/shape/mesh/orient.hpp>
#include <abut/walk/build/assemble.hpp>
#include <abut/walk/build/check_input.hpp>
#include <abut/walk/data.hpp>

#include <algorithm>
#include <tuple>

namespace abut {

using namespace detail;

namespace {

/// Keeps the first of all triangles with the same three corners, and none with fewer corners.
Walkable without_duplicates(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                            std::span<const std::uint32_t> same, WalkMeshReport& report) {
    std::vector<std::tuple<std::array<std::uint32_t, 3>, std::uint32_t>> sorted;
    sorted.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        std::array<std::uint32_t, 3> corners{same[triangles[i].x], same[triangles[i].y], same[triangles[i].z]};
        std::sort(corners.begin(), corners.end());
        sorted.emplace_back(corners, i);
    }
    std::sort(sorted.begin(), sorted.end());
    Walkable result;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const auto& [corners, triangle] = sorted[i];
        if (corners[0] == corners[1] || corners[1] == corners[2])
            ++report.left_out;
        else if (i > 0 && corners == std::get<0>(sorted[i - 1]))
            ++report.duplicates;
        else
            result.number.push_back(triangle);
    }
    std::sort(result.number.begin(), result.number.end());
    for (const std::uint32_t i : result.number)
        result.surface.triangles.push_back({same[triangles[i].x], same[triangles[i].y], same[triangles[i].z]});
    for (const Vec3& point : points) result.surface.points.push_back(point + Vec3(0.0f));
    return result;
}

/// Splits the neighbours of triangles without area, and leaves out those that remain.
void remove_degenerate(Walkable& walkable, WalkMeshData& data, std::span<const std::uint8_t> areas) {
    std::vector<glm::uvec3>& triangles = walkable.surface.triangles;
    const std::vector<glm::uvec3> before = triangles;
    const SliverFlips slivers = flip_slivers(walkable.surface);
    data.report.flat = slivers.flipped;
    std::size_t count = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t number = walkable.number[i];
        if (triangles[i] != before[i]) data.triangles[number] = triangles[i];
        if (!areas.empty()) data.walk[number].area = areas[walkable.number[slivers.source[i]]];
        if (slivers.left[i]) {
            ++data.report.left_out;
            continue;
        }
        triangles[count] = triangles[i];
        walkable.number[count++] = number;
    }
    triangles.resize(count);
    walkable.number.resize(count);
}

/// Orients linked triangles consistently.
void orient_consistently(Walkable& walkable, WalkMeshData& data) {
    const std::vector<glm::uvec3> before = walkable.surface.triangles;
    const WalkLinks links = link_triangles(walkable.surface.points, before);
    std::vector<AdjacentTriangle> across;
    for (const std::array<WalkLink, 3>& of : links.of)
        for (const WalkLink& link : of)
            across.push_back(link.is_border() ? AdjacentTriangle{}
                                              : AdjacentTriangle{link.triangle(), !link.mirrored()});
    orient_consistently(walkable.surface, across);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (walkable.surface.triangles[i] == before[i]) continue;
        glm::uvec3& triangle = data.triangles[walkable.number[i]];
        std::swap(triangle.y, triangle.z);
        ++data.report.turned;
    }
}

}  // namespace

Result<WalkMesh> WalkMesh::build(const PointSpan<3>& given_points, std::span<const glm::uvec3> triangles,
                                 const PointSpan<3>& given_normals, std::span<const std::uint8_t> areas) {
    detail::enter_library();
    const PackedPoints<3> packed_points(given_points), packed_normals(given_normals);
    const std::span<const Vec3> points = packed_points.points(), normals = packed_normals.points();
    if (std::optional<Problem> problem = problem_of_walk_mesh(points, triangles, normals, areas))
        return *std::move(problem);
    auto data = std::make_shared<WalkMeshData>();
    WalkMeshReport& report = data->report;
    data->points.assign(points.begin(), points.end());
    data->triangles.assign(triangles.begin(), triangles.end());
    data->walk.resize(triangles.size());
    data->given_areas = !areas.empty();

    const std::vector<std::uint32_t> same = first_coincident(points);
    Walkable walkable = without_duplicates(points, triangles, same, report);
    remove_degenerate(walkable, *data, areas);
    if (walkable.number.empty()) return Problem{ProblemCode::degenerate, "no triangle of the walk mesh has an area"};
    orient_consistently(walkable, *data);

    for (const Vec3& normal : normals) data->normals.push_back(to_float(normalized(DVec<3>(normal), DVec<3>(0.0))));
    data->given_normals = !normals.empty();
    const Welded& surface = walkable.surface;
    assemble(*data, walkable, link_triangles(surface.points, surface.triangles),
             build_mesh_tree(surface.points, surface.triangles, same));
    return WalkMesh(std::move(data));
}

}  // namespace abut
