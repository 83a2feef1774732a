// glTF data that takes more than copying: instances, skins, morph targets, and compression.

#include "gltf_builder.hpp"
#include <abut/io/gltf/decompress.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/math/aabb.hpp>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;

class GltfExtensions : public test::SceneFiles {
protected:
    Scene read() const {
        Result<Scene> scene = read_scene(write("scene.gltf", builder_.text()));
        if (!scene) throw std::runtime_error(scene.problem().message);
        return *std::move(scene);
    }
    std::string complaint() const {
        const Result<Scene> scene = read_scene(write("scene.gltf", builder_.text()));
        return scene ? std::string() : scene.problem().message;
    }

    GltfBuilder builder_;
};

/// The boxes of all objects in world space, by their paths.
std::map<std::string, Aabb3> boxes_at(const Scene& scene, double time = 0) {
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, time, matrices);
    std::map<std::string, Aabb3> result;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].geometries.empty()) continue;
        Aabb3 box = Aabb3::empty();
        for (const std::uint32_t geometry : scene.nodes[i].geometries)
            for (const Vec3& point : scene.geometries[geometry].points) {
                const Vec3 there(matrices[i] * glm::dvec4(glm::dvec3(point), 1));
                box = merged(box, Aabb3{there, there});
            }
        result[path(scene, i)] = box;
    }
    return result;
}

TEST_F(GltfExtensions, InstancesAreNodes) {
    const int mesh = builder_.add_mesh("Box", box_triangles({1, 1, 1}));
    const int places = builder_.add_points({{10, 0, 0}, {0, 20, 0}});
    const int scales = builder_.add_points({{1, 1, 1}, {2, 2, 2}});
    builder_.add_node("Trees", ",\"mesh\":" + std::to_string(mesh) +
                                   R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" +
                                   std::to_string(places) + ",\"SCALE\":" + std::to_string(scales) + "}}}");
    builder_.add_text(R"(,"extensionsRequired":["EXT_mesh_gpu_instancing"])");
    const auto all = boxes_at(read());
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all.at("Trees/instance 0").min, Vec3(9, -1, -1));
    EXPECT_EQ(all.at("Trees/instance 1").max, Vec3(2, 22, 2));
}

TEST_F(GltfExtensions, InstancesOfDifferentNumbersAreRefused) {
    const int mesh = builder_.add_mesh("Box", box_triangles({1, 1, 1}));
    const int places = builder_.add_points({{10, 0, 0}, {0, 20, 0}});
    const int scales = builder_.add_points({{1, 1, 1}});
    builder_.add_node("Trees", ",\"mesh\":" + std::to_string(mesh) +
                                   R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" +
                                   std::to_string(places) + ",\"SCALE\":" + std::to_string(scales) + "}}}");
    EXPECT_EQ(complaint(), "node 'Trees': instances: 2 and 1 of them");
}

/// A box on a joint that is 5 higher than when it was bound, and moves up by 8 within a second.
void add_skinned_box(GltfBuilder& builder, std::uint8_t joint) {
    const test::Triangles box = box_triangles({1, 1, 1});
    const int points = builder.add_points(box.points), indices = builder.add_indices(box.triangles);
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    for (std::size_t i = 0; i < box.points.size(); ++i) {
        joints.insert(joints.end(), {joint, 0, 0, 0});
        weights.insert(weights.end(), {0.5f, 0.5f, 0, 0});
    }
    const int joint_accessor =
        builder.add_accessor(builder.add_bytes(joints.data(), joints.size()), 5121, "VEC4", box.points.size());
    const int weight_accessor = builder.add_floats(weights, "VEC4", box.points.size());
    std::vector<float> bind(16);
    for (std::size_t i = 0; i < 4; ++i) bind[5 * i] = 1;
    const int matrices = builder.add_floats(bind, "MAT4", 1);
    const int mesh = builder.add_mesh("Body", "{\"attributes\":{\"POSITION\":" + std::to_string(points) +
                                                  ",\"JOINTS_0\":" + std::to_string(joint_accessor) +
                                                  ",\"WEIGHTS_0\":" + std::to_string(weight_accessor) +
                                                  "},\"indices\":" + std::to_string(indices) + "}");
    const int hip = builder.add_node("Hip", R"(,"translation":[0,5,0])");
    builder.add_node("Figure", ",\"skin\":0,\"translation\":[100,0,0],\"mesh\":" + std::to_string(mesh));
    builder.add_motion(hip, "Rise", {0, 1}, {{0, 5, 0}, {0, 13, 0}});
    builder.add_text(R"(,"skins":[{"joints":[)" + std::to_string(hip) + R"(],"inverseBindMatrices":)" +
                     std::to_string(matrices) + "}]");
}

TEST_F(GltfExtensions, SkinsArePosedAndMoveWithTheirRoot) {
    add_skinned_box(builder_, 0);
    const Scene scene = read();
    ASSERT_EQ(boxes_at(scene).size(), 1u);
    EXPECT_EQ(boxes_at(scene).at("Hip/Figure").min, Vec3(-1, 4, -1)) << "the node's own place doesn't count";
    EXPECT_EQ(boxes_at(scene, 1).at("Hip/Figure").min, Vec3(-1, 12, -1));
    EXPECT_TRUE(scene.nodes[0].is_body) << "parts of one figure may overlap";
}

TEST_F(GltfExtensions, JointsThatAreNotThereAreRefused) {
    add_skinned_box(builder_, 3);
    EXPECT_EQ(complaint(), "node 'Figure': skin: joint 3 is out of range");
}

TEST_F(GltfExtensions, MorphTargetsAreAppliedAtTheFirstTime) {
    const test::Triangles box = box_triangles({1, 1, 1});
    const int points = builder_.add_points(box.points), indices = builder_.add_indices(box.triangles);
    const int up = builder_.add_points(std::vector<Vec3>(8, Vec3(0, 10, 0)));
    const int mesh = builder_.add_mesh(
        "Face", GltfBuilder::primitive(points, indices, R"(,"targets":[{"POSITION":)" + std::to_string(up) + "}]"));
    builder_.add_node("Still", ",\"mesh\":" + std::to_string(mesh));
    builder_.add_node("Smile", ",\"weights\":[0.5],\"mesh\":" + std::to_string(mesh));
    const int moving = builder_.add_node("Moving", ",\"mesh\":" + std::to_string(mesh));
    const int times = builder_.add_floats({0, 1}, "SCALAR", 2), weights = builder_.add_floats({1, 0}, "SCALAR", 2);
    builder_.add_animation("Blink", times, weights, moving, "weights", "LINEAR");
    const auto all = boxes_at(read());
    EXPECT_EQ(all.at("Still").min, Vec3(-1, -1, -1));
    EXPECT_EQ(all.at("Smile").min, Vec3(-1, 4, -1));
    EXPECT_EQ(all.at("Moving").min, Vec3(-1, 9, -1));
}

TEST(Meshopt, DamagedDataIsRefused) {
    gltf::Compression compression;
    compression.stride = 12;
    compression.count = 8;
    const std::vector<std::byte> bytes(16, std::byte{0x5a});
    EXPECT_FALSE(gltf::decode_meshopt(compression, bytes));
    compression.count = std::uint64_t{1} << 40;
    EXPECT_EQ(gltf::decode_meshopt(compression, bytes).problem().code, ProblemCode::too_large);
    compression.stride = 3;
    EXPECT_EQ(gltf::decode_meshopt(compression, bytes).problem().message, "meshopt: byteStride can't be 3 here");
}

TEST(Draco, DamagedDataIsRefused) {
    const std::vector<std::byte> bytes(64, std::byte{0x44});
    const Result<gltf::DracoMesh> mesh = gltf::decode_draco(bytes, {});
    ASSERT_FALSE(mesh);
    EXPECT_TRUE(mesh.problem().message.starts_with("Draco: ")) << mesh.problem().message;
}

}  // namespace
}  // namespace abut
