#include "leaks.hpp"

#include "mesh_border.hpp"
#include <abut/math/dvec.hpp>
#include <abut/math/groups.hpp>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace abut::tool {
namespace {

// Of an object's size: what is too narrow to see.
constexpr float crack_width = 1e-4f;

DVec<3> place(const Surface<3>& surface, std::uint32_t point) {
    return DVec<3>(surface.points[point]);
}

DVec<3> area_vector(const Surface<3>& surface, std::uint32_t triangle) {
    const auto& corners = surface.facets[triangle];
    const DVec<3> a = place(surface, corners[0]);
    return cross(place(surface, corners[1]) - a, place(surface, corners[2]) - a) * 0.5;
}

// Edges that are connected by their ends, group by group.
std::vector<std::vector<BorderEdge>> connected(const std::vector<BorderEdge>& edges, std::size_t point_count) {
    Groups points(point_count);
    for (const BorderEdge& edge : edges) points.join(edge.from, edge.to);
    std::map<std::size_t, std::vector<BorderEdge>> groups;
    for (const BorderEdge& edge : edges) groups[points.lowest(edge.from)].push_back(edge);
    std::vector<std::vector<BorderEdge>> result;
    for (auto& [point, group] : groups) result.push_back(std::move(group));
    return result;
}

// Of each edge once, though both sides of a crack have it.
Leak leak_of(LeakKind kind, const Surface<3>& surface, const std::vector<BorderEdge>& edges) {
    Leak leak;
    leak.kind = kind;
    leak.triangle = edges.front().triangle;
    double total = 0;
    DVec<3> weighted(0.0);
    Aabb3 box = Aabb3::empty();
    const BorderEdge* before = nullptr;
    for (const BorderEdge& edge : edges) {
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

// Whether as many edges come to each point as leave it.
bool goes_around(const std::vector<BorderEdge>& edges) {
    std::map<std::uint32_t, int> balance;
    for (const BorderEdge& edge : edges) {
        ++balance[edge.from];
        --balance[edge.to];
    }
    return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

// The area that a closed line goes around as seen from where it is largest.
double flat_area(const Surface<3>& surface, const std::vector<BorderEdge>& edges) {
    const DVec<3> origin = place(surface, edges.front().from);
    DVec<3> sum(0.0);
    for (const BorderEdge& edge : edges)
        sum += cross(place(surface, edge.from) - origin, place(surface, edge.to) - origin) * 0.5;
    return length(sum);
}

// What is connected by edges, also by cracked ones.
Groups shells_of(const Surface<3>& surface, const EdgesOfSurface& edges, const MendedBorder& border) {
    Groups shells(surface.facets.size());
    for (const SharedEdge& edge : edges.shared) shells.join(edge.a, edge.b);
    for (std::size_t i = 1; i < border.cracked.size(); ++i) {
        const BorderEdge &a = border.cracked[i - 1], &b = border.cracked[i];
        if (a.ends() == b.ends()) shells.join(a.triangle, b.triangle);
    }
    return shells;
}

// Whether each triangle turns the other way than the first one it is connected with.
std::vector<bool> turned_against_first(std::size_t triangles, const std::vector<SharedEdge>& shared) {
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> beside(triangles);
    for (const SharedEdge& edge : shared) {
        beside[edge.a].emplace_back(edge.b, edge.turns_alike);
        beside[edge.b].emplace_back(edge.a, edge.turns_alike);
    }
    std::vector<bool> against(triangles), seen(triangles);
    std::vector<std::uint32_t> next;
    for (std::uint32_t first = 0; first < triangles; ++first) {
        if (seen[first]) continue;
        seen[first] = true;
        next.push_back(first);
        while (!next.empty()) {
            const std::uint32_t triangle = next.back();
            next.pop_back();
            for (const auto& [other, alike] : beside[triangle]) {
                if (seen[other]) continue;
                seen[other] = true;
                against[other] = against[triangle] == alike;
                next.push_back(other);
            }
        }
    }
    return against;
}

// One leak for each connected part that isn't of one turn: its smaller half.
void find_flipped(const Surface<3>& surface, const EdgesOfSurface& edges, std::vector<Leak>& out) {
    Groups parts(surface.facets.size());
    for (const SharedEdge& edge : edges.shared) parts.join(edge.a, edge.b);
    std::vector<bool> against = turned_against_first(surface.facets.size(), edges.shared);
    std::map<std::size_t, std::vector<std::uint32_t>> members;
    for (const SharedEdge& edge : edges.shared)
        if (!edge.turns_alike) members[parts.lowest(edge.a)];
    if (members.empty()) return;
    for (const std::uint32_t triangle : edges.triangles)
        if (const auto part = members.find(parts.lowest(triangle)); part != members.end())
            part->second.push_back(triangle);
    for (const auto& [part, triangles] : members) {
        const auto flipped = std::count_if(triangles.begin(), triangles.end(), [&](auto t) { return against[t]; });
        const bool most = 2 * static_cast<std::size_t>(flipped) > triangles.size();
        Leak leak;
        leak.kind = LeakKind::flipped;
        double total = 0;
        DVec<3> weighted(0.0);
        for (const std::uint32_t triangle : triangles) {
            if (against[triangle] == most) continue;
            if (leak.count++ == 0) leak.triangle = triangle;
            const auto& corners = surface.facets[triangle];
            const double area = length(area_vector(surface, triangle));
            total += area;
            for (const std::uint32_t corner : corners) weighted += place(surface, corner) * (area / 3);
        }
        if (leak.count == 0) continue;  // a strip with one side: no turn is right
        leak.center = total > 0 ? to_float<3>(weighted / total) : surface.points[surface.facets[leak.triangle].front()];
        out.push_back(leak);
    }
}

}  // namespace

std::vector<Leak> mesh_leaks(const Surface<3>& surface, float tolerance) {
    std::vector<Leak> result;
    const EdgesOfSurface edges = edges_of(surface);
    const MendedBorder border = mended(surface, edges.border, tolerance);
    if (!border.open.empty()) {
        Groups shells = shells_of(surface, edges, border);
        std::vector<double> area(surface.facets.size());
        for (const std::uint32_t triangle : edges.triangles)
            area[shells.lowest(triangle)] += length(area_vector(surface, triangle));
        for (const std::vector<BorderEdge>& group : connected(border.open, surface.points.size())) {
            Leak leak = leak_of(LeakKind::hole, surface, group);
            const double around = area[shells.lowest(leak.triangle)];
            // The border of a fin ends where that meets other triangles.
            leak.share = around > 0 && goes_around(group) ? flat_area(surface, group) / around : 1;
            result.push_back(leak);
        }
    }
    for (const auto& group : connected(border.cracked, surface.points.size()))
        result.push_back(leak_of(LeakKind::crack, surface, group));
    for (const auto& group : connected(edges.crowded, surface.points.size()))
        result.push_back(leak_of(LeakKind::crowded, surface, group));
    find_flipped(surface, edges, result);
    std::sort(result.begin(), result.end(), [](const Leak& a, const Leak& b) {
        return std::tuple(a.kind, a.triangle, a.count) < std::tuple(b.kind, b.triangle, b.count);
    });
    return result;
}

std::vector<LevelLeak> find_leaks(const std::vector<StandingObject<3>>& objects,
                                  const std::function<bool(const StandingObject<3>&)>& is_meant_closed) {
    struct Made {
        std::size_t first = 0, count = 0;
        bool meant_closed = false;
    };
    std::map<std::size_t, Made> models;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        Made& made = models.try_emplace(objects[i].model, Made{i, 0, false}).first->second;
        ++made.count;
        if (is_meant_closed && is_meant_closed(objects[i])) made.meant_closed = true;
    }
    std::vector<LevelLeak> result;
    for (const auto& [model, made] : models) {
        if (is_meant_closed && !made.meant_closed) continue;
        const StandingObject<3>& object = objects[made.first];
        for (const Leak& leak : mesh_leaks(object.surface, crack_width * object.radius)) {
            if (leak.kind == LeakKind::hole && !made.meant_closed && leak.share >= small_hole) continue;
            result.push_back({leak, made.first, made.count});
        }
    }
    std::stable_sort(result.begin(), result.end(),
                     [](const LevelLeak& a, const LevelLeak& b) { return a.object < b.object; });
    return result;
}

}  // namespace abut::tool
