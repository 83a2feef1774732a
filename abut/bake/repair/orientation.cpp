#include <abut/bake/repair/orientation.hpp>
#include <abut/bake/solid.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace abut::detail {
namespace {

constexpr std::uint32_t none = no_index;

void flip(glm::uvec3& triangle) {
    std::swap(triangle.y, triangle.z);
}

/// A closed patch as a solid, oriented outwards.
struct Shell {
    std::uint32_t patch = 0;
    std::vector<glm::uvec3> triangles;
    double volume = 0;
    bool outwards = true;  ///< original orientation
    Aabb3 box = Aabb3::empty();
    std::optional<Mesh> mesh;        ///< only if another shell may be inside it
    std::uint32_t enclosing = none;  ///< the smallest shell that contains it
    bool faces_inwards = false;      ///< final orientation
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
        if (!shell.outwards) std::for_each(shell.triangles.begin(), shell.triangles.end(), flip);
        for (const glm::uvec3& t : shell.triangles)
            for (int k = 0; k < 3; ++k) {
                const Vec3& point = surface.points[t[k]];
                shell.box = merged(shell.box, Aabb3{point, point});
            }
        result.push_back(std::move(shell));
    }
    return result;
}

/// True if `outer` contains the centroids of several triangles, spread over `inner`. Shells that intersect don't
/// contain each other.
bool is_inside(const Welded& surface, const Shell& inner, const Shell& outer) {
    constexpr std::size_t max_tested = 9;
    const std::size_t count = std::min(max_tested, inner.triangles.size());
    for (std::size_t i = 0; i < count; ++i) {
        const glm::uvec3& t = inner.triangles[i * inner.triangles.size() / count];
        const DVec<3> sum = DVec<3>(surface.points[t.x]) + DVec<3>(surface.points[t.y]) + DVec<3>(surface.points[t.z]);
        if (!solid_contains(*outer.mesh, to_float(sum / 3.0))) return false;
    }
    return true;
}

void find_enclosing_shells(const Welded& surface, std::vector<Shell>& shells) {
    if (shells.size() < 2) return;
    std::vector<Aabb3> boxes;
    for (const Shell& shell : shells) boxes.push_back(shell.box);
    Bvh<3> tree;
    tree.build(boxes);
    for (std::uint32_t i = 0; i < shells.size(); ++i) {
        std::vector<std::pair<double, std::uint32_t>> candidates;
        tree.each_overlapping(boxes[i], [&](std::uint32_t j) {
            if (j != i && contains(boxes[j], boxes[i]) && shells[j].volume > shells[i].volume)
                candidates.emplace_back(shells[j].volume, j);
        });
        std::sort(candidates.begin(), candidates.end());
        for (const auto& [volume, j] : candidates) {
            Shell& outer = shells[j];
            if (!outer.mesh) outer.mesh = *Mesh::build(surface.points, outer.triangles);
            if (!is_inside(surface, shells[i], outer)) continue;
            shells[i].enclosing = j;
            break;
        }
    }
}

/// True for an outermost shell that was oriented inwards and contains at least two that were oriented outwards.
bool is_room(const std::vector<Shell>& shells, std::uint32_t outer, const Patches& patches) {
    if (shells[outer].outwards || !patches.was_consistent[shells[outer].patch]) return false;
    const auto is_in_it = [&](const Shell& shell) {
        return shell.enclosing == outer && shell.outwards && patches.was_consistent[shell.patch];
    };
    return std::count_if(shells.begin(), shells.end(), is_in_it) >= 2;
}

}  // namespace

InwardSurfaces orient_outwards(Welded& surface, const Patches& patches) {
    std::vector<Shell> shells = closed_shells(surface, patches);
    find_enclosing_shells(surface, shells);
    std::vector<bool> flips(patches.count(), false);
    InwardSurfaces result;
    // Largest first: an enclosing shell is larger than the enclosed one.
    std::vector<std::uint32_t> order(shells.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return shells[a].volume > shells[b].volume; });
    for (const std::uint32_t i : order) {
        Shell& shell = shells[i];
        if (shell.enclosing == none) {
            shell.faces_inwards = is_room(shells, i, patches);
            result.rooms += shell.faces_inwards;
        } else {
            const Shell& outer = shells[shell.enclosing];
            const bool is_consistent = patches.was_consistent[shell.patch] && patches.was_consistent[outer.patch];
            const bool has_same_orientation = is_consistent && shell.outwards == outer.outwards;
            shell.faces_inwards = has_same_orientation == outer.faces_inwards;
            result.cavities += shell.faces_inwards;
        }
        flips[shell.patch] = shell.outwards == shell.faces_inwards;
    }
    for (std::size_t i = 0; i < surface.triangles.size(); ++i)
        if (flips[patches.of[i]]) flip(surface.triangles[i]);
    return result;
}

}  // namespace abut::detail
