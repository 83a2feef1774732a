// Loads any bytes as a walk mesh: the load refuses them, or the mesh can be walked on and saved again.

#include "bytes.hpp"
#include "with_checksum.hpp"
#include <abut/walk/file.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

using namespace abut;
using fuzz::require;

void require_place(const WalkMesh& mesh, const WalkPoint& place) {
    require(place.triangle < mesh.triangles().size() && mesh.is_walkable(place.triangle));
    require(place.weights.x >= 0 && place.weights.y >= 0 && place.weights.z >= 0);
    require(place.weights.x + place.weights.y + place.weights.z == 1);
    require(detail::is_finite(mesh.to_world(place)) && detail::is_finite(mesh.smooth_normal(place)));
}

/// Walks from the middle of each of the first triangles, along the axes, as far as the mesh is large; and calls the
/// other queries.
void walk_about(const WalkMesh& mesh) {
    const Aabb3 box = bounds(mesh);
    const float far = std::max({box.max.x - box.min.x, box.max.y - box.min.y, box.max.z - box.min.z});
    require(far > 0);
    const WalkOptions options{.max_crossings = 1000};
    for (std::uint32_t triangle = 0; triangle < std::min<std::size_t>(mesh.triangles().size(), 64); ++triangle) {
        require(mesh.component(triangle) < mesh.report().components);
        if (!mesh.is_walkable(triangle)) continue;
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 step(0);
            step[axis] = far;
            const Walked walked = mesh.walk({triangle, {0.25f, 0.25f, 0.5f}}, step, options);
            require_place(mesh, walked.place);
            require(mesh.component(walked.place.triangle) == mesh.component(triangle));
            require_place(mesh, mesh.walk(walked.place, -(walked.turn * step), options).place);
            require_place(mesh, mesh.nearest(mesh.to_world(walked.place) + step));
            if (mesh.nearest_along(box.min, step)) require_place(mesh, *mesh.nearest_along(box.min, step));
            const auto path = mesh.path({triangle, {1, 0, 0}}, walked.place);
            require(!path || detail::is_finite(path->back()));
        }
    }
}

void check(std::span<const std::byte> bytes) {
    const Result<WalkMesh> mesh = load_walk_mesh(bytes);
    if (!mesh) {
        require(!mesh.problem().message.empty());
        return;
    }
    require(is_walk_mesh(bytes));
    const std::vector<std::byte> again = save(*mesh);
    require(std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()));
    walk_about(*mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    abut::fuzz::check_with_checksum(data, size, check);
    return 0;
}
