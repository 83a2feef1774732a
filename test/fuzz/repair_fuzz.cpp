// Mesh repair on any triangles: a surface with a correct report, or a Problem with a message.

#include "bytes.hpp"
#include <abut/bake/repair.hpp>
#include <abut/shape/mesh/half_edges.hpp>

#include <vector>

using namespace abut;
using fuzz::Bytes, fuzz::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    RepairOptions options;
    options.weld_distance = static_cast<double>(bytes.byte() % 4) * 0.5;
    options.hole_edges = bytes.byte() % 32u;
    options.hole_area = bytes.byte() / 255.0;
    const std::uint32_t point_count = bytes.byte() % 64u;
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < point_count; ++i) {
        const float x = bytes.coordinate(), y = bytes.coordinate(), z = bytes.coordinate();
        points.emplace_back(x, y, z);
    }
    std::vector<glm::uvec3> triangles;
    while (!bytes.empty()) {
        const std::uint8_t a = bytes.byte(), b = bytes.byte(), c = bytes.byte();
        triangles.emplace_back(a, b, c);
    }

    const Result<Repaired> result = repair(points, triangles, options);
    if (!result) {
        require(!result.problem().message.empty());
        return 0;
    }
    require(!result->triangles.empty());
    std::vector<bool> is_used(result->points.size(), false);
    for (const glm::uvec3& t : result->triangles)
        for (int k = 0; k < 3; ++k) {
            require(t[k] < result->points.size());
            is_used[t[k]] = true;
        }
    for (const bool used : is_used) require(used);
    const detail::EdgeFaults faults = detail::edge_faults(result->triangles);
    require(faults.closed == result->closed && faults.boundary == result->repairs.open_edges &&
            faults.non_manifold == result->repairs.non_manifold_edges &&
            faults.inconsistent == result->repairs.disagreeing_edges);
    require(!described(result->repairs).empty());
    return 0;
}
