// All numbers are little endian. The parts, in order: "abutwlk\n", the version, flags for normals and areas, the counts
// of the report that cannot be derived from the triangles, the numbers of points, triangles, leaves and nodes, the
// points, the triangles, their links, the normals, the areas, the structure of the tree, and a checksum of everything
// before it. Frames, fans and boxes are not stored but computed from the rest, so a file cannot have them wrong.

#include <abut/math/detail/blob.hpp>
#include <abut/math/detail/coincident.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/mesh/tree_topology.hpp>
#include <abut/walk/build/assemble.hpp>
#include <abut/walk/build/check_input.hpp>
#include <abut/walk/file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace abut {

using namespace detail;

namespace {

constexpr std::array<char, 8> magic{'a', 'b', 'u', 't', 'w', 'l', 'k', '\n'};
constexpr std::uint32_t version = 1;

/// Marks a triangle that is left out, in place of its links.
constexpr glm::uvec3 no_links(WalkLink::none - 1);

/// The counts of the report that depend on the original triangles.
template <class Report, class Take>
void each_count(Report& report, Take take) {
    take(report.duplicates);
    take(report.flat);
    take(report.left_out);
    take(report.turned);
    take(report.non_manifold_edges);
}

Problem problem(std::string message) {
    return {ProblemCode::bad_format, std::move(message)};
}
std::string of_triangle(std::size_t triangle) {
    return "triangle " + std::to_string(triangle) + " of the walk mesh ";
}

/// The contents of a file before validation.
struct Parts {
    std::array<std::uint64_t, 5> counts{};
    std::vector<Vec3> points, normals;
    std::vector<glm::uvec3> triangles, links;
    std::vector<std::uint8_t> areas;
    MeshTreeTopology plan;
    bool has_normals = false, has_areas = false;
};

bool begins_well(BlobReader& reader) {
    std::array<char, 8> start{};
    for (char& c : start)
        if (!reader.number(c)) return false;
    return start == magic;
}

std::optional<Problem> read(std::span<const std::byte> bytes, Parts& parts) {
    BlobReader reader(bytes);
    if (!begins_well(reader)) return problem("this is not a walk mesh: its signature is wrong");
    const Problem too_short = problem("the walk mesh is truncated");
    std::uint32_t number = 0;
    if (!reader.number(number)) return too_short;
    if (number != version) return problem("the walk mesh has an unknown version");
    if (reader.left() < sizeof(std::uint64_t)) return too_short;
    if (!reader.checksum(bytes)) return problem("the walk mesh is damaged: its checksum is wrong");

    std::uint8_t normals = 0, areas = 0;
    std::uint64_t points = 0, triangles = 0, walkable = 0, leaves = 0, nodes = 0;
    bool whole = reader.number(normals) && reader.number(areas);
    for (std::uint64_t& count : parts.counts) whole = whole && reader.number(count);
    for (std::uint64_t* count : {&points, &triangles, &walkable, &leaves, &nodes})
        whole = whole && reader.number(*count);
    // The bound keeps eight times the number from overflowing.
    whole = whole && nodes < bytes.size();
    whole = whole && reader.array(parts.points, points) && reader.array(parts.triangles, triangles) &&
            reader.array(parts.links, triangles) && reader.array(parts.normals, normals != 0 ? points : 0) &&
            reader.array(parts.areas, areas != 0 ? triangles : 0) && reader.array(parts.plan.order, walkable) &&
            reader.array(parts.plan.corners, walkable) && reader.array(parts.plan.counts, leaves) &&
            reader.array(parts.plan.children, mesh_lanes * nodes);
    if (!whole) return too_short;
    if (reader.left() != 0) return problem("the walk mesh has extra bytes at its end");
    if (normals > 1 || areas > 1) return problem("the walk mesh is of an unknown kind");
    parts.has_normals = normals == 1;
    parts.has_areas = areas == 1;
    return std::nullopt;
}

/// Saved normals have length 1 or 0.
std::optional<Problem> check_normals(std::span<const Vec3> normals) {
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double square = length_squared(DVec<3>(normals[i]));
        if (square != 0 && !(std::abs(square - 1) < 1e-6))
            return problem("normal " + std::to_string(i) + " of the walk mesh is not of unit length");
    }
    return std::nullopt;
}

/// Collects the walkable triangles; each must have an area.
std::optional<Problem> take_walkable(const Parts& parts, std::span<const std::uint32_t> same, Walkable& walkable) {
    for (const Vec3& point : parts.points) walkable.surface.points.push_back(point + Vec3(0.0f));
    for (std::uint32_t i = 0; i < parts.triangles.size(); ++i) {
        if (parts.links[i] == no_links) continue;
        const glm::uvec3& t = parts.triangles[i];
        const std::vector<Vec3>& points = parts.points;
        if (has_zero_area(points[t.x], points[t.y], points[t.z])) return problem(of_triangle(i) + "has no area");
        walkable.surface.triangles.push_back({same[t.x], same[t.y], same[t.z]});
        walkable.number.push_back(i);
    }
    const std::size_t all = parts.triangles.size(), left_out = all - walkable.number.size();
    const auto [duplicates, flat, gone, turned, non_manifold_edges] = parts.counts;
    if (left_out == all) return problem("no triangle of the walk mesh is walkable");
    if (duplicates > left_out || gone != left_out - duplicates || flat > all || turned > all ||
        non_manifold_edges > all)
        return problem("the counts of the walk mesh contradict its triangles");
    return std::nullopt;
}

/// True if two linked sides are the same edge, traversed as the link says.
bool is_edge(const glm::uvec3& a, std::uint32_t side_a, const glm::uvec3& b, std::uint32_t side_b, bool mirrored) {
    const auto corner = [](const glm::uvec3& t, std::uint32_t k) { return t[static_cast<glm::length_t>(k)]; };
    const std::uint32_t from = corner(b, side_b), to = corner(b, next_corner(side_b));
    return corner(a, side_a) == (mirrored ? from : to) && corner(a, next_corner(side_a)) == (mirrored ? to : from);
}

/// The index of each triangle of the mesh among the walkable ones.
std::vector<std::uint32_t> places_of(const Walkable& walkable, std::size_t triangles) {
    std::vector<std::uint32_t> result(triangles, WalkLink::none);
    for (std::uint32_t i = 0; i < walkable.number.size(); ++i) result[walkable.number[i]] = i;
    return result;
}

/// Links must be mutual, and both sides the same edge.
std::optional<Problem> take_links(const Parts& parts, const Walkable& walkable, std::span<const std::uint32_t> place,
                                  WalkLinks& links) {
    const std::vector<glm::uvec3>& triangles = walkable.surface.triangles;
    links.of.resize(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t number = walkable.number[i];
        for (std::uint32_t k = 0; k < 3; ++k) {
            const WalkLink link{parts.links[number][static_cast<glm::length_t>(k)]};
            if (link.is_border()) {
                ++links.border;
                continue;
            }
            const std::uint32_t beyond = link.triangle(), side = link.side();
            const bool sound = beyond < place.size() && beyond != number && side < 3 &&
                               parts.links[beyond][static_cast<glm::length_t>(side)] ==
                                   WalkLink::to(number, k, link.mirrored()).code &&
                               is_edge(triangles[i], k, triangles[place[beyond]], side, link.mirrored());
            if (!sound) return problem(of_triangle(number) + "is linked to a side that isn't adjacent");
            links.of[i][k] = WalkLink::to(place[beyond], side, link.mirrored());
            links.mirrored += link.mirrored() && number < beyond;
        }
    }
    return std::nullopt;
}

}  // namespace

std::vector<std::byte> save(const WalkMesh& mesh) {
    const WalkMeshData& data = mesh.data();
    const bool has_normals = data.given_normals, has_areas = data.given_areas;
    const MeshTreeTopology plan = topology_of(data.tree);
    std::vector<glm::uvec3> links;
    std::vector<std::uint8_t> areas;
    for (const WalkTriangle& walk : data.walk) {
        links.push_back(walk.is_walkable() ? glm::uvec3(walk.link[0].code, walk.link[1].code, walk.link[2].code)
                                           : no_links);
        areas.push_back(static_cast<std::uint8_t>(walk.area));
    }
    BlobWriter writer;
    writer.bytes.reserve(128 + 24 * data.points.size() + 35 * data.triangles.size());
    for (const char c : magic) writer.number(c);
    writer.number(version);
    writer.number(static_cast<std::uint8_t>(has_normals));
    writer.number(static_cast<std::uint8_t>(has_areas));
    each_count(data.report, [&](std::size_t count) { writer.number(static_cast<std::uint64_t>(count)); });
    writer.number(static_cast<std::uint64_t>(data.points.size()));
    writer.number(static_cast<std::uint64_t>(data.triangles.size()));
    writer.number(static_cast<std::uint64_t>(plan.order.size()));
    writer.number(static_cast<std::uint64_t>(plan.counts.size()));
    writer.number(static_cast<std::uint64_t>(data.tree.nodes.size()));
    writer.array(std::span(data.points));
    writer.array(std::span(data.triangles));
    writer.array(std::span<const glm::uvec3>(links));
    if (has_normals) writer.array(std::span(data.normals));
    if (has_areas) writer.array(std::span<const std::uint8_t>(areas));
    writer.array(std::span(plan.order));
    writer.array(std::span(plan.corners));
    writer.array(std::span(plan.counts));
    writer.array(std::span(plan.children));
    writer.checksum();
    return std::move(writer.bytes);
}

Result<WalkMesh> load_walk_mesh(std::span<const std::byte> bytes) {
    Parts parts;
    if (std::optional<Problem> wrong = read(bytes, parts)) return *std::move(wrong);
    if (std::optional<Problem> wrong = problem_of_walk_mesh(parts.points, parts.triangles, parts.normals, parts.areas))
        return *std::move(wrong);
    const std::vector<std::uint32_t> same = first_coincident(parts.points);
    Walkable walkable;
    WalkLinks links;
    std::optional<Problem> wrong = check_normals(parts.normals);
    if (!wrong) wrong = take_walkable(parts, same, walkable);
    if (wrong) return *std::move(wrong);
    const std::vector<std::uint32_t> place = places_of(walkable, parts.triangles.size());
    wrong = take_links(parts, walkable, place, links);
    if (wrong) return *std::move(wrong);
    for (std::uint32_t& item : parts.plan.order) item = item < place.size() ? place[item] : WalkLink::none;
    std::optional<MeshTree> tree = build_mesh_tree(walkable.surface.points, walkable.surface.triangles, parts.plan);
    if (!tree) return problem("the tree of the walk mesh doesn't match its triangles");

    auto data = std::make_shared<WalkMeshData>();
    std::size_t next = 0;
    each_count(data->report, [&](std::size_t& count) { count = static_cast<std::size_t>(parts.counts[next++]); });
    links.non_manifold_edges = data->report.non_manifold_edges;
    data->walk.resize(parts.triangles.size());
    for (std::size_t i = 0; i < parts.areas.size(); ++i) data->walk[i].area = parts.areas[i];
    data->points = std::move(parts.points);
    data->triangles = std::move(parts.triangles);
    data->normals = std::move(parts.normals);
    data->given_normals = parts.has_normals;
    data->given_areas = parts.has_areas;
    assemble(*data, walkable, links, *std::move(tree));
    return WalkMesh(std::move(data));
}

bool is_walk_mesh(std::span<const std::byte> bytes) {
    BlobReader reader(bytes);
    return begins_well(reader);
}

}  // namespace abut
