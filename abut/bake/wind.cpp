#include <abut/bake/half_edges.hpp>
#include <abut/bake/solid.hpp>
#include <abut/bake/wind.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/mesh.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace abut {
namespace {

constexpr std::uint32_t none = no_side;

void turn(glm::uvec3& triangle) {
    std::swap(triangle.y, triangle.z);
}

double area_of(const Welded& surface, const glm::uvec3& t) {
    const DVec<3> a(surface.points[t.x]), b(surface.points[t.y]), c(surface.points[t.z]);
    return length(cross(b - a, c - a));
}

/// The other side of an edge that exactly two triangles share, whichever way they go; and whether they agree.
struct Across {
    std::uint32_t triangle = none;
    bool agrees = true;
};

std::vector<Across> across(std::span<const glm::uvec3> triangles) {
    std::vector<Across> result(3 * triangles.size());
    const std::vector<HalfEdge> sorted = sorted_half_edges(triangles);
    each_edge(sorted, [&](std::span<const HalfEdge> edge) {
        if (edge.size() != 2) return;
        const bool agrees = edge[0].upwards != edge[1].upwards;
        result[edge[0].side] = {edge[1].side / 3, agrees};
        result[edge[1].side] = {edge[0].side / 3, agrees};
    });
    return result;
}

/// A closed patch as a solid of its own, seen from outside.
struct Shell {
    std::uint32_t patch = 0;
    std::vector<glm::uvec3> triangles;
    double volume = 0;
    bool outwards = true;  ///< as it came
    Aabb3 box = Aabb3::empty();
    std::optional<Mesh> mesh;     ///< of those that some other may be inside of
    std::uint32_t around = none;  ///< the least shell that it is inside of
    bool faces_inwards = false;   ///< as it ends
};

std::vector<Shell> closed_shells(const Welded& surface, const Patches& patches) {
    std::vector<std::vector<glm::uvec3>> of_patch(patches.count());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) of_patch[patches.of[i]].push_back(surface.triangles[i]);
    std::vector<Shell> result;
    for (std::uint32_t i = 0; i < of_patch.size(); ++i) {
        if (!edge_faults(of_patch[i]).closed) continue;
        const double volume = signed_volume(surface.points, of_patch[i]);
        if (volume == 0) continue;
        Shell shell;
        shell.patch = i;
        shell.triangles = std::move(of_patch[i]);
        shell.volume = std::abs(volume);
        shell.outwards = volume > 0;
        if (!shell.outwards) std::for_each(shell.triangles.begin(), shell.triangles.end(), turn);
        for (const glm::uvec3& t : shell.triangles)
            for (int k = 0; k < 3; ++k) {
                const Vec3& point = surface.points[t[k]];
                shell.box = merged(shell.box, Aabb3{point, point});
            }
        result.push_back(std::move(shell));
    }
    return result;
}

/// By the middles of a few triangles, spread over all of them: shells that cross aren't inside of one another.
bool is_inside(const Welded& surface, const Shell& inner, const Shell& outer) {
    constexpr std::size_t most = 9;
    const std::size_t count = std::min(most, inner.triangles.size());
    for (std::size_t i = 0; i < count; ++i) {
        const glm::uvec3& t = inner.triangles[i * inner.triangles.size() / count];
        const DVec<3> sum = DVec<3>(surface.points[t.x]) + DVec<3>(surface.points[t.y]) + DVec<3>(surface.points[t.z]);
        if (!solid_contains(*outer.mesh, to_float(sum / 3.0))) return false;
    }
    return true;
}

void find_what_is_around(const Welded& surface, std::vector<Shell>& shells) {
    if (shells.size() < 2) return;
    std::vector<Aabb3> boxes;
    for (const Shell& shell : shells) boxes.push_back(shell.box);
    Bvh<3> tree;
    tree.build(boxes);
    for (std::uint32_t i = 0; i < shells.size(); ++i) {
        std::vector<std::pair<double, std::uint32_t>> larger;
        tree.each_overlapping(boxes[i], [&](std::uint32_t j) {
            if (j != i && contains(boxes[j], boxes[i]) && shells[j].volume > shells[i].volume)
                larger.emplace_back(shells[j].volume, j);
        });
        std::sort(larger.begin(), larger.end());
        for (const auto& [volume, j] : larger) {
            Shell& outer = shells[j];
            if (!outer.mesh) outer.mesh = *Mesh::build(surface.points, outer.triangles);
            if (!is_inside(surface, shells[i], outer)) continue;
            shells[i].around = j;
            break;
        }
    }
}

/// Whether an outermost shell came seen from inside, with two or more in it that came seen from outside.
bool is_room(const std::vector<Shell>& shells, std::uint32_t outer, const Patches& patches) {
    if (shells[outer].outwards || !patches.agreed[shells[outer].patch]) return false;
    const auto is_in_it = [&](const Shell& shell) {
        return shell.around == outer && shell.outwards && patches.agreed[shell.patch];
    };
    return std::count_if(shells.begin(), shells.end(), is_in_it) >= 2;
}

}  // namespace

Patches wind_alike(Welded& surface) {
    std::vector<glm::uvec3>& triangles = surface.triangles;
    const std::vector<Across> beyond = across(triangles);
    Patches patches{std::vector<std::uint32_t>(triangles.size(), none), {}};
    std::vector<bool> turned(triangles.size(), false);
    std::vector<std::uint32_t> members;
    for (std::uint32_t first = 0; first < triangles.size(); ++first) {
        if (patches.of[first] != none) continue;
        const auto patch = static_cast<std::uint32_t>(patches.count());
        patches.agreed.push_back(true);
        patches.of[first] = patch;
        members.assign(1, first);
        double turned_area = 0, kept_area = 0;
        for (std::size_t next = 0; next < members.size(); ++next) {
            const std::uint32_t triangle = members[next];
            (turned[triangle] ? turned_area : kept_area) += area_of(surface, triangles[triangle]);
            for (std::uint32_t side = 3 * triangle; side < 3 * triangle + 3; ++side) {
                const auto [neighbour, agrees] = beyond[side];
                if (neighbour == none) continue;
                if (!agrees) patches.agreed[patch] = false;
                if (patches.of[neighbour] != none) continue;
                patches.of[neighbour] = patch;
                turned[neighbour] = turned[triangle] == agrees;
                members.push_back(neighbour);
            }
        }
        const bool turns = turned_area <= kept_area;
        for (const std::uint32_t triangle : members)
            if (turned[triangle] == turns) turn(triangles[triangle]);
    }
    return patches;
}

Insides face_outwards(Welded& surface, const Patches& patches) {
    std::vector<Shell> shells = closed_shells(surface, patches);
    find_what_is_around(surface, shells);
    std::vector<bool> turns(patches.count(), false);
    Insides result;
    // From large to small: what is around a shell is larger than it.
    std::vector<std::uint32_t> order(shells.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return shells[a].volume > shells[b].volume; });
    for (const std::uint32_t i : order) {
        Shell& shell = shells[i];
        if (shell.around == none) {
            shell.faces_inwards = is_room(shells, i, patches);
            result.rooms += shell.faces_inwards;
        } else {
            const Shell& outer = shells[shell.around];
            const bool is_told = patches.agreed[shell.patch] && patches.agreed[outer.patch];
            const bool is_alike = is_told && shell.outwards == outer.outwards;
            shell.faces_inwards = is_alike == outer.faces_inwards;
            result.cavities += shell.faces_inwards;
        }
        turns[shell.patch] = shell.outwards == shell.faces_inwards;
    }
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        if (turns[patches.of[i]]) turn(surface.triangles[i]);
    return result;
}

}  // namespace abut
