#include "tool/faults/leaks.hpp"

#include "tool/faults/surface_edges.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

// Width of a crack relative to the object's size: narrower ones are invisible.
constexpr float crack_width = 1e-4f;

DVec<3> place(const Surface<3>& surface, std::uint32_t point) {
    return DVec<3>(surface.points[point]);
}

DVec<3> area_vector(const Surface<3>& surface, std::uint32_t triangle) {
    const auto& corners = surface.facets[triangle];
    const DVec<3> a = place(surface, corners[0]);
    return cross(place(surface, corners[1]) - a, place(surface, corners[2]) - a) * 0.5;
}

// Connected components of edges, joined by shared vertices.
std::vector<std::vector<BoundaryEdge>> connected(const std::vector<BoundaryEdge>& edges, std::size_t point_count) {
    UnionFind points(point_count);
    for (const BoundaryEdge& edge : edges) points.unite(edge.from, edge.to);
    std::map<std::size_t, std::vector<BoundaryEdge>> groups;
    for (const BoundaryEdge& edge : edges) groups[points.find(edge.from)].push_back(edge);
    std::vector<std::vector<BoundaryEdge>> result;
    for (auto& [point, group] : groups) result.push_back(std::move(group));
    return result;
}

// Builds a leak from edges. The two sides of a crack have the same edges, which count once.
Leak leak_of(LeakKind kind, const Surface<3>& surface, const std::vector<BoundaryEdge>& edges) {
    Leak leak;
    leak.kind = kind;
    leak.triangle = edges.front().triangle;
    double total = 0;
    DVec<3> weighted(0.0);
    Aabb3 box = Aabb3::empty();
    const BoundaryEdge* before = nullptr;
    for (const BoundaryEdge& edge : edges) {
        leak.triangle = std::min(leak.triangle, edge.triangle);
        if (before != nullptr && before->ends() == edge.ends()) continue;
        before = &edge;
        for (const std::uint32_t end : {edge.from, edge.to})
            box = merged(box, Aabb3{surface.points[end], surface.points[end]});
        const DVec<3> a = place(surface, edge.from), b = place(surface, edge.to);
        const double edge_length = length(b - a);
        total += edge_length;
        weighted += (a + b) * (0.5 * edge_length);
        ++leak.count;
    }
    leak.length = static_cast<float>(total);
    leak.extent = static_cast<float>(length(DVec<3>(box.max) - DVec<3>(box.min)));
    leak.center = to_float<3>(total > 0 ? weighted / total : place(surface, edges.front().from));
    return leak;
}

// True if in-degree equals out-degree at each vertex: the edges form closed loops.
bool is_closed_loop(const std::vector<BoundaryEdge>& edges) {
    std::map<std::uint32_t, int> balance;
    for (const BoundaryEdge& edge : edges) {
        ++balance[edge.from];
        --balance[edge.to];
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

// The maximum area of a projection of a closed loop.
double projected_area(const Surface<3>& surface, const std::vector<BoundaryEdge>& edges) {
    const DVec<3> origin = place(surface, edges.front().from);
    DVec<3> sum(0.0);
    for (const BoundaryEdge& edge : edges)
        sum += cross(place(surface, edge.from) - origin, place(surface, edge.to) - origin) * 0.5;
    return length(sum);
}

// Connected components of triangles, joined by shared edges and by cracked ones.
UnionFind shells_of(const Surface<3>& surface, const SurfaceEdges& edges, const WeldedBoundary& boundary) {
    UnionFind shells(surface.facets.size());
    for (const SharedEdge& edge : edges.shared) shells.unite(edge.a, edge.b);
    for (std::size_t i = 1; i < boundary.cracked.size(); ++i) {
        const BoundaryEdge &a = boundary.cracked[i - 1], &b = boundary.cracked[i];
        if (a.ends() == b.ends()) shells.unite(a.triangle, b.triangle);
    }
    return shells;
}

// Per triangle: true if it is oriented inconsistently with the first triangle of its connected component.
std::vector<bool> inconsistent_with_first(std::size_t triangles, const std::vector<SharedEdge>& shared) {
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> adjacent(triangles);
    for (const SharedEdge& edge : shared) {
        adjacent[edge.a].emplace_back(edge.b, edge.is_consistent);
        adjacent[edge.b].emplace_back(edge.a, edge.is_consistent);
    }
    std::vector<bool> inconsistent(triangles), seen(triangles);
    std::vector<std::uint32_t> next;
    for (std::uint32_t first = 0; first < triangles; ++first) {
        if (seen[first]) continue;
        seen[first] = true;
        next.push_back(first);
        while (!next.empty()) {
            const std::uint32_t triangle = next.back();
            next.pop_back();
            for (const auto& [other, is_consistent] : adjacent[triangle]) {
                if (seen[other]) continue;
                seen[other] = true;
                inconsistent[other] = inconsistent[triangle] == is_consistent;
                next.push_back(other);
            }
        }
    }
    return inconsistent;
}

// Adds a leak for each connected component with inconsistent orientations: the smaller set of triangles.
void find_flipped(const Surface<3>& surface, const SurfaceEdges& edges, std::vector<Leak>& out) {
    UnionFind parts(surface.facets.size());
    for (const SharedEdge& edge : edges.shared) parts.unite(edge.a, edge.b);
    std::vector<bool> inconsistent = inconsistent_with_first(surface.facets.size(), edges.shared);
    std::map<std::size_t, std::vector<std::uint32_t>> members;
    for (const SharedEdge& edge : edges.shared)
        if (!edge.is_consistent) members[parts.find(edge.a)];
    if (members.empty()) return;
    for (const std::uint32_t triangle : edges.triangles)
        if (const auto part = members.find(parts.find(triangle)); part != members.end())
            part->second.push_back(triangle);
    for (const auto& [part, triangles] : members) {
        const auto flipped = std::count_if(triangles.begin(), triangles.end(), [&](auto t) { return inconsistent[t]; });
        const bool is_majority = 2 * static_cast<std::size_t>(flipped) > triangles.size();
        Leak leak;
        leak.kind = LeakKind::flipped;
        double total = 0;
        DVec<3> weighted(0.0);
        for (const std::uint32_t triangle : triangles) {
            if (inconsistent[triangle] == is_majority) continue;
            if (leak.count++ == 0) leak.triangle = triangle;
            const auto& corners = surface.facets[triangle];
            const double area = length(area_vector(surface, triangle));
            total += area;
            for (const std::uint32_t corner : corners) weighted += place(surface, corner) * (area / 3);
        }
        if (leak.count == 0) continue;  // a non-orientable surface: no orientation is consistent
        leak.center = total > 0 ? to_float<3>(weighted / total) : surface.points[surface.facets[leak.triangle].front()];
        out.push_back(leak);
    }
}

}  // namespace

std::vector<Leak> mesh_leaks(const Surface<3>& surface, float tolerance) {
    std::vector<Leak> result;
    const SurfaceEdges edges = edges_of(surface);
    const WeldedBoundary boundary = weld_boundary(surface, edges.boundary, tolerance);
    if (!boundary.open.empty()) {
        UnionFind shells = shells_of(surface, edges, boundary);
        std::vector<double> area(surface.facets.size());
        for (const std::uint32_t triangle : edges.triangles)
            area[shells.find(triangle)] += length(area_vector(surface, triangle));
        for (const std::vector<BoundaryEdge>& group : connected(boundary.open, surface.points.size())) {
            Leak leak = leak_of(LeakKind::hole, surface, group);
            const double surface_area = area[shells.find(leak.triangle)];
            // The boundary of a fin ends where the fin meets other triangles.
            leak.share = surface_area > 0 && is_closed_loop(group) ? projected_area(surface, group) / surface_area : 1;
            result.push_back(leak);
        }
    }
    for (const auto& group : connected(boundary.cracked, surface.points.size()))
        result.push_back(leak_of(LeakKind::crack, surface, group));
    for (const auto& group : connected(edges.non_manifold, surface.points.size()))
        result.push_back(leak_of(LeakKind::non_manifold, surface, group));
    find_flipped(surface, edges, result);
    std::sort(result.begin(), result.end(), [](const Leak& a, const Leak& b) {
        return std::tuple(a.kind, a.triangle, a.count) < std::tuple(b.kind, b.triangle, b.count);
    });
    return result;
}

std::vector<LevelLeak> find_leaks(const std::vector<ViewedObject<3>>& objects,
                                  const std::function<bool(const ViewedObject<3>&)>& is_meant_closed) {
    struct MeshUse {
        std::size_t first = 0, count = 0;
        bool meant_closed = false;
    };
    std::map<std::size_t, MeshUse> models;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        MeshUse& use = models.try_emplace(objects[i].model, MeshUse{i, 0, false}).first->second;
        ++use.count;
        if (is_meant_closed && is_meant_closed(objects[i])) use.meant_closed = true;
    }
    std::vector<LevelLeak> result;
    for (const auto& [model, use] : models) {
        if (is_meant_closed && !use.meant_closed) continue;
        const ViewedObject<3>& object = objects[use.first];
        for (const Leak& leak : mesh_leaks(object.surface, crack_width * object.radius)) {
            if (leak.kind == LeakKind::hole && !use.meant_closed && leak.share >= small_hole) continue;
            result.push_back({leak, use.first, use.count});
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const LevelLeak& a, const LevelLeak& b) { return a.object < b.object; });
    return result;
}

}  // namespace abut::tool
