// The glTF reader against Assimp's, on a file that both read correctly, and on data that Assimp reads wrongly.

#include "gltf_builder.hpp"
#include <abut/io/mesh/read_assimp.hpp>
#include <abut/io/read_scene.hpp>

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using test::GltfBuilder;

class ReadGltf : public test::SceneFiles {
protected:
    Scene read(const std::string& text) const {
        Result<Scene> scene = read_scene(write("scene.gltf", text));
        if (!scene) throw std::runtime_error(scene.problem().message);
        return *std::move(scene);
    }
    std::string complaint(const std::string& text) const {
        const Result<Scene> scene = read_scene(write("scene.gltf", text));
        return scene ? std::string() : scene.problem().message;
    }
};

/// All corners of all triangles of each object, in world space at a time.
std::map<std::string, std::vector<glm::dvec3>> corners(const Scene& scene, double time) {
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, time, matrices);
    std::map<std::string, std::vector<glm::dvec3>> result;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        for (const std::uint32_t geometry : scene.nodes[i].geometries)
            for (const glm::uvec3& t : scene.geometries[geometry].triangles)
                for (int k = 0; k < 3; ++k)
                    result[path(scene, i)].emplace_back(
                        matrices[i] * glm::dvec4(glm::dvec3(scene.geometries[geometry].points[t[k]]), 1));
    return result;
}

TEST_F(ReadGltf, AgreesWithAssimp) {
    const std::filesystem::path file = std::filesystem::path(ABUT_SCENE_FOLDER) / "level.gltf";
    const Result<Scene> ours = read_scene(file);
    ASSERT_TRUE(ours) << ours.problem().message;
    Result<detail::ReadScene> other = detail::read_assimp(file, {});
    ASSERT_TRUE(other) << other.problem().message;
    const Result<Scene> theirs = detail::finish_scene(*std::move(other), {});
    ASSERT_TRUE(theirs) << theirs.problem().message;

    EXPECT_EQ(key_times(*ours).size(), key_times(*theirs).size());
    std::size_t compared = 0;
    for (const double time : frame_times(*ours, 7)) {
        const auto a = corners(*ours, time);
        const auto b = corners(*theirs, time);
        ASSERT_EQ(a.size(), b.size());
        for (const auto& [name, points] : a) {
            // Stepped and cubic keys, which Assimp 5.2 interpolates linearly.
            if (name.ends_with("/Lift_Signal") || name.ends_with("/Balloon")) continue;
            const auto twin = b.find(name);
            ASSERT_NE(twin, b.end()) << name;
            ASSERT_EQ(points.size(), twin->second.size()) << name;
            for (std::size_t i = 0; i < points.size(); ++i)
                ASSERT_LT(glm::length(points[i] - twin->second[i]), 1e-4) << name << " at " << time;
            ++compared;
        }
    }
    EXPECT_GT(compared, 700u);
}

TEST_F(ReadGltf, ThroughAssimpNodesOfOneNameAreWarnedOf) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", test::box_triangles({1, 1, 1}));
    builder.add_node("Crate", mesh);
    builder.add_node("Crate", mesh);
    builder.add_motion(1, "Fall", {0, 1}, {{0, 0, 0}, {0, 8, 0}});
    builder.add_text(R"(,"scenes":[{"nodes":[0,1]}],"scene":0)");
    const std::string text = builder.text();
    const Result<detail::ReadScene> scene = detail::read_assimp(test::bytes_of(text), ".gltf", {});
    ASSERT_TRUE(scene) << scene.problem().message;
    EXPECT_EQ(scene->scene.warnings,
              std::vector<std::string>{"several nodes are named 'Crate': the first is taken for the one that moves"});
    EXPECT_TRUE(read(text).warnings.empty());
}

TEST_F(ReadGltf, QuantizedPositions) {
    GltfBuilder builder;
    const std::vector<std::int16_t> shorts{0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0};
    const int view = builder.add_bytes(shorts.data(), shorts.size() * sizeof(std::int16_t));
    builder.add_text(R"(,"extensionsRequired":["KHR_mesh_quantization"])");
    const int as_they_are = builder.add_accessor(view, 5122, "VEC3", 4);
    const int normalized = builder.add_accessor(view, 5122, "VEC3", 4, R"(,"normalized":true)");
    const int indices = builder.add_indices({{0, 1, 3}});
    builder.add_node("Raw", builder.add_mesh("Raw", GltfBuilder::primitive(as_they_are, indices)));
    builder.add_node("Unit", builder.add_mesh("Unit", GltfBuilder::primitive(normalized, indices)));
    const Scene scene = read(builder.text());
    ASSERT_EQ(scene.geometries.size(), 2u);
    EXPECT_EQ(scene.geometries[0].points[1], Vec3(0, 32767, 0));
    EXPECT_EQ(scene.geometries[1].points[1], Vec3(0, 1, 0));
    EXPECT_EQ(scene.geometries[1].points[3], Vec3(-1, 0, 0));
}

TEST_F(ReadGltf, StridesAndOffsets) {
    // Interleaved positions: 4 bytes before each, 8 after it.
    std::vector<float> floats;
    for (const Vec3& p : {Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 0)})
        for (const float number : {-1.0f, p.x, p.y, p.z, -2.0f, -3.0f}) floats.push_back(number);
    GltfBuilder builder;
    builder.add_bytes(floats.data(), floats.size() * sizeof(float));
    const std::string text = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":72,
        "uri":"data:application/octet-stream;base64,)" +
                             test::base64(builder.bytes()) + R"("}],
        "bufferViews":[{"buffer":0,"byteLength":72,"byteStride":24}],
        "accessors":[{"bufferView":0,"byteOffset":4,"componentType":5126,"type":"VEC3","count":3}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
    EXPECT_EQ(read(text).geometries[0].points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 0}}));
}

TEST_F(ReadGltf, SparseAccessors) {
    GltfBuilder builder;
    const int base = builder.add_bytes(std::vector<float>(9, 0.0f).data(), 36);
    const std::uint8_t places[] = {1, 2};
    const int indices = builder.add_bytes(places, sizeof places);
    const float values[] = {1, 0, 0, 0, 1, 0};
    const int replaced = builder.add_bytes(values, sizeof values);
    const auto sparse = [&](int count) {
        return R"(,"sparse":{"count":)" + std::to_string(count) + R"(,"indices":{"bufferView":)" +
               std::to_string(indices) + R"(,"componentType":5121},"values":{"bufferView":)" +
               std::to_string(replaced) + "}}";
    };
    const int positions = builder.add_accessor(base, 5126, "VEC3", 3, sparse(2));
    builder.add_node("A", builder.add_mesh("A", GltfBuilder::primitive(positions, builder.add_indices({{0, 1, 2}}))));
    EXPECT_EQ(read(builder.text()).geometries[0].points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST_F(ReadGltf, StripsAndFans) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    const auto triangles = [&](int mode) {
        GltfBuilder builder;
        const int positions = builder.add_points(points);
        builder.add_node(
            "A", builder.add_mesh("A", "{\"mode\":" + std::to_string(mode) +
                                           ",\"attributes\":{\"POSITION\":" + std::to_string(positions) + "}}"));
        return read(builder.text()).geometries[0].triangles;
    };
    EXPECT_EQ(triangles(4), (std::vector<glm::uvec3>{{0, 1, 2}}));
    EXPECT_EQ(triangles(5), (std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    EXPECT_EQ(triangles(6), (std::vector<glm::uvec3>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST_F(ReadGltf, TheSeamsOfStripsAreNoTriangles) {
    GltfBuilder builder;
    const int positions = builder.add_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
    const std::vector<std::uint16_t> corners{0, 1, 2, 2, 3, 3, 4, 5};
    const int indices =
        builder.add_accessor(builder.add_bytes(corners.data(), 2 * corners.size()), 5123, "SCALAR", corners.size());
    builder.add_node("A", builder.add_mesh("A", GltfBuilder::primitive(positions, indices, ",\"mode\":5")));
    EXPECT_EQ(read(builder.text()).geometries[0].triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {3, 5, 4}}));
}

TEST_F(ReadGltf, InstancesShareTheirGeometry) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", test::box_triangles({1, 1, 1}));
    builder.add_node("A", mesh);
    builder.add_node("B", mesh);
    const Scene scene = read(builder.text());
    EXPECT_EQ(scene.geometries.size(), 1u);
    EXPECT_EQ(scene.nodes[0].geometries, scene.nodes[1].geometries);
}

TEST_F(ReadGltf, OnlyTheSceneThatIsShown) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", test::box_triangles({1, 1, 1}));
    for (const char* name : {"A", "B", "C"}) builder.add_node(name, mesh);
    builder.add_text(R"(,"scenes":[{"nodes":[0]},{"nodes":[2,1]}],"scene":1)");
    const Scene scene = read(builder.text());
    ASSERT_EQ(scene.nodes.size(), 2u);
    EXPECT_EQ(scene.nodes[0].name, "B");
    EXPECT_EQ(scene.nodes[1].name, "C");
}

TEST_F(ReadGltf, WhatPointsNowhereIsNamed) {
    const auto with = [](const std::string& members) { return R"({"asset":{"version":"2.0"},)" + members + "}"; };
    EXPECT_EQ(complaint(with(R"("nodes":[{"mesh":7}])")), "nodes[0].mesh: index 7 is out of range (0 exist)");
    EXPECT_EQ(complaint(with(R"("nodes":[{"children":[1]}])")), "nodes[0].children: index 1 is out of range (1 exist)");
    EXPECT_EQ(complaint(with(R"("nodes":[{"children":[-1]}])")), "nodes[0].children: a whole number was expected");
    EXPECT_EQ(complaint(with(R"("nodes":[{"mesh":"Box"}])")), "nodes[0].mesh: a whole number was expected");
    EXPECT_EQ(complaint(with(R"("nodes":{})")), "nodes: an array was expected");
    EXPECT_EQ(complaint(with(R"("nodes":[7])")), "nodes[0]: an object was expected");
    EXPECT_EQ(complaint(with(R"("scenes":[{"nodes":[3]}])")), "scenes[0].nodes: index 3 is out of range (0 exist)");
    EXPECT_EQ(complaint(with(R"("scenes":[{}],"scene":2)")), "scene[0].scene: index 2 is out of range (1 exist)");

    const auto mesh_of = [&](const std::string& buffers, const std::string& view, const std::string& accessor) {
        return complaint(with(R"("buffers":[)" + buffers + R"(],"bufferViews":[)" + view + R"(],"accessors":[)" +
                              accessor + R"(],"meshes":[{"name":"M","primitives":[{"attributes":{"POSITION":0}}]}],
                              "nodes":[{"mesh":0}])"));
    };
    const std::string bytes =
        R"({"byteLength":36,"uri":"data:;base64,)" + test::base64(std::vector<std::byte>(36)) + "\"}";
    const std::string all = R"({"buffer":0,"byteLength":36})";
    const std::string three = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":3})";
    EXPECT_EQ(mesh_of(bytes, all, three), "all triangles in it have zero area: 0 objects")
        << "all is well but for that";
    EXPECT_EQ(mesh_of(bytes, all, R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4})"),
              "mesh 'M': accessors[0]: bufferViews[0] has 36 bytes, too few for 4 elements of 12 bytes");
    EXPECT_EQ(mesh_of(bytes, all, R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":9007199254740992})"),
              "mesh 'M': accessors[0]: bufferViews[0] has 36 bytes, too few for 9007199254740992 elements of 12 bytes");
    EXPECT_EQ(mesh_of(bytes, all, R"({"bufferView":0,"componentType":9,"type":"VEC3","count":3})"),
              "mesh 'M': accessors[0]: unknown componentType 9");
    EXPECT_EQ(mesh_of(bytes, all, R"({"bufferView":0,"componentType":5126,"type":"VEC2","count":3})"),
              "mesh 'M': accessors[0]: elements of 3 components were expected");
    EXPECT_EQ(mesh_of(bytes, R"({"buffer":0,"byteOffset":1,"byteLength":36})", three),
              "mesh 'M': accessors[0]: bufferViews[0] reaches past the end of its buffer");
    EXPECT_EQ(mesh_of(R"({"byteLength":36,"uri":"data:;base64,AAAA"})", all, three),
              "mesh 'M': accessors[0]: buffers[0] is truncated: 3 of 36 bytes");
    EXPECT_EQ(mesh_of(R"({"byteLength":36,"uri":"data:;base64,A!"})", all, three),
              "mesh 'M': accessors[0]: buffers[0]: base64: bad character at byte 1");
    EXPECT_EQ(mesh_of(R"({"byteLength":36,"uri":"gone.bin"})", all, three),
              "mesh 'M': accessors[0]: buffers[0]: 'gone.bin': no such file");
    EXPECT_EQ(mesh_of(R"({"byteLength":36,"uri":"http://example.org/a.bin"})", all, three),
              "mesh 'M': accessors[0]: buffers[0]: 'http://example.org/a.bin': isn't a file beside this one");
    EXPECT_EQ(mesh_of(R"({"byteLength":36})", all, three),
              "mesh 'M': accessors[0]: buffers[0] is truncated: 0 of 36 bytes");
}

TEST_F(ReadGltf, UnknownExtensionsThatAreRequiredAreNamed) {
    GltfBuilder builder;
    builder.add_node("A", builder.add_mesh("A", test::box_triangles({1, 1, 1})));
    GltfBuilder harmless = builder;
    builder.add_text(R"(,"extensionsRequired":["KHR_lights_punctual","ACME_soft_mesh"])");
    EXPECT_EQ(complaint(builder.text()),
              "requires the extension 'ACME_soft_mesh', which abut doesn't know: export without it");
    harmless.add_text(
        R"(,"extensionsRequired":["KHR_lights_punctual","KHR_materials_unlit","KHR_texture_basisu","KHR_mesh_quantization"])");
    EXPECT_EQ(complaint(harmless.text()), "");
}

TEST_F(ReadGltf, Version1IsRefusedWithAReason) {
    EXPECT_EQ(complaint(R"({"asset":{"version":"1.0"},"nodes":{}})"),
              "is glTF 1.0, which was replaced in 2017 and is not read: export it as glTF 2.0");
}

}  // namespace
}  // namespace abut
