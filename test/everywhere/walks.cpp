// Walk meshes: walks, steps, nearest places and paths. The surfaces and steps are integers.

#include "../walk/hashed_walks.hpp"
#include "sections.hpp"
#include <abut/walk/survey.hpp>

namespace abut::everywhere {
namespace {

void add_paths(Hash& hash, const WalkMesh& mesh, std::uint64_t seed) {
    oracle::Random random(seed);
    const Aabb3 box = bounds(mesh);
    const auto place = [&] {
        Vec3 result;
        for (int i = 0; i < 3; ++i) {
            const auto low = static_cast<double>(box.min[i]), high = static_cast<double>(box.max[i]);
            result[i] = random.uniform_float(low, high);
        }
        return mesh.nearest(result);
    };
    for (int i = 0; i < 20; ++i) {
        const WalkPoint from = place(), to = place();
        test::add_place(hash, from);
        const auto path = mesh.find_path(from, to, {.nearest_reachable = true});
        if (!path) continue;
        for (const Vec3& point : path->points) hash.add<3>(point);
        hash.add(static_cast<float>(path->length));
    }
    for (const WalkComponent& component : survey(mesh).components) hash.add(static_cast<float>(component.area));
}

void add_walks_and_paths(Hash& hash, const test::Surface& surface, std::uint64_t seed) {
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    test::add_walks(hash, *mesh, surface, seed, 2000);
    add_paths(hash, *mesh, seed);
}

}  // namespace

void add_walks(Hash& hash) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        oracle::Random random(seed);
        add_walks_and_paths(hash, test::rough_ground(random), seed);
        const int shift = static_cast<int>(seed);
        const test::Surface solid =
            test::cell_surface(4, [&](int x, int y, int z) { return (x * 5 + y * 3 + z + shift) % 4 != 0; });
        add_walks_and_paths(hash, solid, seed);
    }
}

}  // namespace abut::everywhere
