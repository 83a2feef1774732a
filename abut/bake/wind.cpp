#include <abut/bake/solid.hpp>
#include <abut/bake/wind.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/math/dvec.hpp>
#include <abut/shape/half_edges.hpp>
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
