// Everything that the library saves: shapes, fields, walk meshes and worlds.

#include "../../scenes/solid_meshes.hpp"
#include "../../scenes/terrain.hpp"
#include "../shape/saved_shapes.hpp"
#include "../world/support/random_shapes.hpp"
#include "blobs.hpp"
#include "sections.hpp"
#include <abut/bake/field.hpp>
#include <abut/field/file.hpp>
#include <abut/walk/file.hpp>
#include <abut/world/file.hpp>

namespace abut::everywhere {
namespace {

using Bytes = std::vector<std::byte>;

template <class Load, class Save>
Bytes saved_again(std::span<const std::byte> bytes, const Load& load, const Save& save) {
    auto loaded = load(bytes);
    return loaded ? save(*loaded) : Bytes();
}

template <int D>
Blob world_blob() {
    oracle::Random random(D);
    World<D> world;
    for (int i = 0; i < 40; ++i) {
        const Pose<D> pose = test::random_pose<D>(random, 3);
        const ItemOptions<D> options{.pose = pose, .user = random.bits(), .fixed = i % 5 == 0};
        world.add(Box<D>{Vec<D>(0.0f), Vec<D>(0.4f)}, options);
        world.add(Capsule<D>{Vec<D>(0.0f), Vec<D>(0.4f), 0.2f}, {.pose = pose});
    }
    world.update();
    return {"world" + std::to_string(D), *save_with_shapes(world), [](std::span<const std::byte> bytes) {
                return saved_again(
                    bytes, [](auto b) { return load_world<D>(b); },
                    [](World<D>& loaded) { return *save_with_shapes(loaded); });
            }};
}

template <int D>
Blob field_blob(const Field<D>& field, const char* name) {
    return {name, save(field), [](std::span<const std::byte> bytes) {
                return saved_again(bytes, load_field<D>, [](const Field<D>& loaded) { return save(loaded); });
            }};
}

}  // namespace

std::vector<Blob> blobs() {
    std::vector<Blob> result;
    test::each_saved_type([&]<class S>() {
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
            oracle::Random random(seed);
            const std::string name = "shape" + std::to_string(result.size());
            result.push_back({name, test::file_of(test::random_shape<S>(random)), [](std::span<const std::byte> bytes) {
                                  return saved_again(bytes, test::load<S>,
                                                     [](const S& loaded) { return test::file_of(loaded); });
                              }});
        }
    });
    const scenes::SolidMesh house = scenes::house();
    result.push_back(field_blob(*bake_field(house.points, house.triangles, {.cell = 1}), "field"));
    result.push_back(
        field_blob(*bake_field(house.points, house.triangles,
                               {.cell = 1, .lookup = FieldLookup::gradient, .quantised = true, .closest_points = true}),
                   "field with all"));
    result.push_back(field_blob(*bake_field(Box2{{0, 0}, {1, 1}, {0.6f, 0.8f}}, {.cell = 0.1f}), "flat field"));
    oracle::Random random(1);
    const scenes::Terrain ground = scenes::random_terrain(12, random);
    result.push_back(
        {"walk mesh", save(*WalkMesh::build(ground.points, ground.triangles)), [](std::span<const std::byte> bytes) {
             return saved_again(bytes, load_walk_mesh, [](const WalkMesh& loaded) { return save(loaded); });
         }});
    result.push_back(world_blob<2>());
    result.push_back(world_blob<3>());
    return result;
}

void add_files(Hash& hash) {
    for (const Blob& blob : blobs()) {
        for (const std::byte byte : blob.bytes) hash.add(std::to_integer<std::uint64_t>(byte));
        hash.add(std::uint64_t{blob.save_again(blob.bytes) == blob.bytes});
    }
}

}  // namespace abut::everywhere
