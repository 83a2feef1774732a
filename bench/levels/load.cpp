// Loading of a mesh of a million triangles, beside building it and beside a plain copy of its bytes. Memory that is new
// to the process is included for all, as a game would pay for it.

#include "../../scenes/terrain.hpp"
#include "../bench.hpp"
#include <abut/shape/file.hpp>
#include <abut/shape/mesh.hpp>

#include <cstddef>
#include <memory>

namespace abut::bench {
namespace {

constexpr std::uint32_t columns = 708;  // 1,002,528 triangles
constexpr std::uint64_t seed = 1;

/// Every side writes the number of triangles.
Job load_terrain() {
    oracle::Random random(seed);
    const auto ground = std::make_shared<const scenes::Terrain>(scenes::random_terrain(columns, random));
    const auto bytes =
        std::make_shared<const std::vector<std::byte>>(save(*Mesh::build(ground->points, ground->triangles)));
    const double count = static_cast<double>(ground->triangles.size());
    const Side load{"abut", [bytes](std::span<double> values) {
                        values[0] = static_cast<double>(load_mesh(*bytes)->triangles().size());
                    }};
    const Side build{"abut, build", [ground](std::span<double> values) {
                         const Result<Mesh> mesh = Mesh::build(ground->points, ground->triangles);
                         values[0] = static_cast<double>(mesh->triangles().size());
                     }};
    const Side copy{"copy of the bytes", [bytes, count](std::span<double> values) {
                        const std::vector<std::byte> copied(*bytes);
                        values[0] = copied.back() == bytes->back() ? count : 0;
                    }};
    return {.items = ground->triangles.size(), .values = 1, .sides = {load, build, copy}};
}

}  // namespace

std::vector<Bench> level_load_benches() {
    return {{"levels/load/mesh/1m", load_terrain}};
}

}  // namespace abut::bench
