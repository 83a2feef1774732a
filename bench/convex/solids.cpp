// Convex decomposition of meshes, compared with Bullet's HACD at the same number of parts. As the parts differ, the
// answer is the volume that they add, in percent of the mesh's. abut's parts cover the surface, which is verified.
// HACD's hulls have fewer vertices and leave out up to 2 % of the diagonal here, which is tolerated.

#include "../../scenes/solid_meshes.hpp"
#include "../../test/oracle/bake/part_quality.hpp"
#include "../bench.hpp"
#include "bullet_hacd.hpp"
#include <abut/bake/decompose.hpp>
#include <abut/shape/weld.hpp>

#include <limits>
#include <memory>
#include <optional>

namespace abut::bench {
namespace {

constexpr std::uint32_t corners = 64, samples = 20'000;

/// Decomposes in each call; the quality of the parts is measured once, as it is deterministic.
template <class Decompose>
Side side(const char* who, const std::shared_ptr<const Welded>& mesh, std::optional<std::uint32_t> max_parts,
          Decompose decompose) {
    const auto extra = std::make_shared<std::optional<double>>();
    return {who, [=](std::span<double> values) {
                const std::vector<Polyhedron> found = decompose(*mesh);
                if (!*extra) {
                    const oracle::PartQuality quality =
                        oracle::quality_of(mesh->points, mesh->triangles, found, samples, 1);
                    const bool right = !max_parts || (found.size() <= *max_parts && quality.uncovered == 0);
                    *extra = right ? 100 * quality.extra : std::numeric_limits<double>::quiet_NaN();
                }
                values[0] = **extra;
            }};
}

Job solid_job(const scenes::SolidMesh& solid, std::uint32_t parts) {
    const auto mesh = std::make_shared<const Welded>(weld(solid.points, solid.triangles));
    Job job;
    job.items = mesh->triangles.size();
    job.values = 1;
    job.tolerance = std::numeric_limits<double>::infinity();
    job.sides.push_back(side("abut", mesh, parts, [parts](const Welded& welded) {
        return *decompose(welded.points, welded.triangles,
                          {.max_parts = parts, .concavity = 0.01, .max_vertices = corners});
    }));
    job.sides.push_back(side("Bullet HACD", mesh, std::nullopt, [parts](const Welded& welded) {
        std::vector<Polyhedron> result;
        for (const std::vector<Vec3>& hull : hacd_parts(welded.points, welded.triangles, parts, corners))
            result.push_back(*Polyhedron::build(hull));
        return result;
    }));
    return job;
}

}  // namespace

std::vector<Bench> convex_solid_benches() {
    return {{"convex/solid/house/16", [] { return solid_job(scenes::house(), 16); }},
            {"convex/solid/knot 768/16", [] { return solid_job(scenes::knotted_tube(48, 8), 16); }},
            {"convex/solid/knot 6144/32", [] { return solid_job(scenes::knotted_tube(192, 16), 32); }}};
}

}  // namespace abut::bench
