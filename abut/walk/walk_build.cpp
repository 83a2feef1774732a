#include <abut/math/coincident.hpp>
#include <abut/math/groups.hpp>
#include <abut/shape/check_triangles.hpp>
#include <abut/shape/tidy.hpp>
#include <abut/shape/wind_alike.hpp>
#include <abut/walk/walk_data.hpp>
#include <abut/walk/walk_fans.hpp>
#include <abut/walk/walk_links.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace abut {
namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 28;
constexpr float most_coordinate = 1e15f;

std::optional<Problem> problem_of(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                  std::span<const Vec3> normals, std::span<const std::uint8_t> areas) {
    if (std::optional<Problem> problem = problem_of_triangles(points, triangles, "a walk mesh")) return problem;
    if (triangles.size() >= most_triangles)
        return Problem{ProblemCode::too_large, "a walk mesh has fewer than 2^28 triangles"};
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int a = 0; a < 3; ++a)
            if (std::abs(points[i][a]) > most_coordinate)
                return Problem{ProblemCode::too_large, "point " + std::to_string(i) + " has a coordinate above 1e15",
                               i};
    const auto as_many = [](std::size_t given, std::size_t needed, const char* of, const char* needs) {
        return std::to_string(given) + of + std::to_string(needed) + needs;
    };
    if (!normals.empty() && normals.size() != points.size())
        return Problem{ProblemCode::bad_argument, as_many(normals.size(), points.size(), " normals of ", " points")};
    if (!areas.empty() && areas.size() != triangles.size())
        return Problem{ProblemCode::bad_argument, as_many(areas.size(), triangles.size(), " areas of ", " triangles")};
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (!is_finite(normals[i]))
            return Problem{ProblemCode::not_finite, "normal " + std::to_string(i) + " is not finite", i};
    return std::nullopt;
}

/// The triangles that there are to walk on, by points that are welded; and which of the input each one is.
struct Walkable {
    Welded surface;
    std::vector<std::uint32_t> number;
};

/// The first of all that have the same corners, but for those of fewer than three.
Walkable without_doubles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
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
            ++report.doubled;
        else
            result.number.push_back(triangle);
    }
    std::sort(result.number.begin(), result.number.end());
    for (const std::uint32_t i : result.number)
        result.surface.triangles.push_back({same[triangles[i].x], same[triangles[i].y], same[triangles[i].z]});
    for (const Vec3& point : points) result.surface.points.push_back(point + Vec3(0.0f));
    return result;
}

/// Cuts what has no area, and leaves out what can't be cut.
void mend(Walkable& walkable, WalkMeshData& data, std::span<const std::uint8_t> areas) {
    std::vector<glm::uvec3>& triangles = walkable.surface.triangles;
    const std::vector<glm::uvec3> before = triangles;
    const CutSlivers slivers = cut_slivers(walkable.surface);
    data.report.flat = slivers.cut;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t number = walkable.number[i];
        if (triangles[i] != before[i]) data.triangles[number] = triangles[i];
        if (!areas.empty()) data.walk[number].area = areas[walkable.number[slivers.part_of[i]]];
        if (slivers.left[i]) {
            ++data.report.left_out;
            continue;
        }
        triangles[kept] = triangles[i];
        walkable.number[kept++] = number;
    }
    triangles.resize(kept);
    walkable.number.resize(kept);
}

/// Turns triangles so that they agree with those that they go on in.
void turn_alike(Walkable& walkable, WalkMeshData& data) {
    const std::vector<glm::uvec3> before = walkable.surface.triangles;
    const WalkLinks links = link_triangles(walkable.surface.points, before);
    std::vector<AcrossEdge> across;
    for (const std::array<WalkLink, 3>& of : links.of)
        for (const WalkLink& link : of)
            across.push_back(link.is_border() ? AcrossEdge{} : AcrossEdge{link.triangle(), !link.mirrored()});
    wind_alike(walkable.surface, across);
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (walkable.surface.triangles[i] == before[i]) continue;
        glm::uvec3& triangle = data.triangles[walkable.number[i]];
        std::swap(triangle.y, triangle.z);
        ++data.report.turned;
    }
}

/// Where its corners are: in space, and in its own frame.
void place(WalkTriangle& walk, const Welded& surface, const glm::uvec3& triangle) {
    for (int k = 0; k < 3; ++k) walk.corner[k] = surface.points[triangle[k]];
    const DVec<3> first(walk.corner[0]), along = DVec<3>(walk.corner[1]) - first,
                                         other = DVec<3>(walk.corner[2]) - first;
    const double width = length(along);
    walk.inverse_width = 1 / width;
    walk.third = dot(along, other) / width;
    walk.inverse_height = width / length(cross(along, other));
}

/// Where the corner beyond each side is, unfolded.
void unfold(WalkTriangle& walk, const Welded& surface, std::span<const glm::uvec3> triangles,
            const std::array<WalkLink, 3>& links, const glm::uvec3& triangle) {
    for (std::uint32_t k = 0; k < 3; ++k) {
        const WalkLink link = links[k];
        if (link.is_border()) continue;
        const auto at = [&](const glm::uvec3& of, std::uint32_t corner) {
            return DVec<3>(surface.points[of[static_cast<glm::length_t>(corner)]]);
        };
        const DVec<3> from = at(triangle, k), to = at(triangle, next_corner(k));
        const DVec<3> far = at(triangles[link.triangle()], next_corner(next_corner(link.side())));
        const DVec<3> side = to - from;
        const double square = length_squared(side);
        walk.back[k] = 0.5 - dot(far - from, side) / square;
        walk.away[k] = length(cross(side, far - from)) / square;
    }
}

/// Parts of the surface between which there is no way.
std::size_t find_islands(const Walkable& walkable, const WalkLinks& links, std::vector<std::uint32_t>& islands) {
    Groups groups(walkable.number.size());
    for (std::size_t i = 0; i < links.of.size(); ++i)
        for (const WalkLink& link : links.of[i])
            if (!link.is_border()) groups.join(i, link.triangle());
    std::size_t count = 0;
    for (std::size_t i = 0; i < walkable.number.size(); ++i) {
        const std::size_t first = groups.lowest(i);
        islands[walkable.number[i]] =
            first == i ? static_cast<std::uint32_t>(count++) : islands[walkable.number[first]];
    }
    return count;
}

void set_normals(WalkMeshData& data, const Walkable& walkable, const WalkLinks& links, std::span<const Vec3> normals) {
    data.given_normals = !normals.empty();
    if (data.given_normals) {
        for (const Vec3& normal : normals) data.normals.push_back(to_float(normalized(DVec<3>(normal), DVec<3>(0.0))));
        data.corner_normals = data.triangles;
        return;
    }
    WalkNormals fans = fan_normals(walkable.surface.points, walkable.surface.triangles, links);
    data.normals = std::move(fans.normals);
    data.corner_normals.resize(data.triangles.size());
    for (std::size_t i = 0; i < walkable.number.size(); ++i) data.corner_normals[walkable.number[i]] = fans.of[i];
}

}  // namespace

Result<WalkMesh> WalkMesh::build(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                 std::span<const Vec3> normals, std::span<const std::uint8_t> areas) {
    if (std::optional<Problem> problem = problem_of(points, triangles, normals, areas)) return *std::move(problem);
    auto data = std::make_shared<WalkMeshData>();
    WalkMeshReport& report = data->report;
    data->points.assign(points.begin(), points.end());
    data->triangles.assign(triangles.begin(), triangles.end());
    data->walk.resize(triangles.size());
    data->islands.resize(triangles.size());
    data->given_areas = !areas.empty();

    const std::vector<std::uint32_t> same = first_coincident(points);
    Walkable walkable = without_doubles(points, triangles, same, report);
    mend(walkable, *data, areas);
    if (walkable.number.empty()) return Problem{ProblemCode::degenerate, "no triangle of the walk mesh has an area"};
    turn_alike(walkable, *data);

    const std::vector<glm::uvec3>& walked = walkable.surface.triangles;
    const WalkLinks links = link_triangles(walkable.surface.points, walked);
    report.crowded = links.crowded;
    report.mirrored = links.mirrored;
    report.border = links.border;
    report.pinched = pinched_points(walked, links);
    report.islands = find_islands(walkable, links, data->islands);
    for (std::size_t i = 0; i < walked.size(); ++i) {
        WalkTriangle& walk = data->walk[walkable.number[i]];
        place(walk, walkable.surface, walked[i]);
        unfold(walk, walkable.surface, walked, links.of[i], walked[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const WalkLink link = links.of[i][k];
            if (!link.is_border())
                walk.link[k] = WalkLink::to(walkable.number[link.triangle()], link.side(), link.mirrored());
            data->bounds = merged(data->bounds, Aabb3{walk.corner[k], walk.corner[k]});
        }
    }
    set_normals(*data, walkable, links, normals);
    data->tree = build_mesh_tree(walkable.surface.points, walked, same);
    for (std::uint32_t& item : data->tree.order) item = walkable.number[item];
    data->leaf_of.resize(triangles.size());
    for (std::uint32_t i = 0; i < data->tree.leaves.size(); ++i) {
        const MeshLeaf& leaf = data->tree.leaves[i];
        for (std::uint32_t lane = 0; lane < leaf.count(); ++lane)
            data->leaf_of[data->tree.order[leaf.first + lane]] = i;
    }
    return WalkMesh(std::move(data));
}

}  // namespace abut
