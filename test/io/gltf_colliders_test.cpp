// What a glTF file says of collision: colliders by extensions, by extras and by names, rather than what is drawn.

#include "gltf_builder.hpp"
#include <abut/io/mesh/collider_names.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/math/aabb.hpp>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace abut {
namespace {

using detail::ColliderName;
using test::box_triangles;
using test::GltfBuilder;

class GltfColliders : public test::SceneFiles {
protected:
    GltfColliders() { mesh_ = builder_.add_mesh("Drawn", box_triangles({5, 5, 5})); }

    Scene read(const ReadOptions& options = {}) const {
        Result<Scene> scene = read_scene(write("scene.gltf", builder_.text()), options);
        if (!scene) throw std::runtime_error(scene.problem().message);
        return *std::move(scene);
    }
    std::string complaint() const {
        const Result<Scene> scene = read_scene(write("scene.gltf", builder_.text()));
        return scene ? std::string() : scene.problem().message;
    }
    void add(const std::string& name, const std::string& more) {
        builder_.add_node(name, ",\"mesh\":" + std::to_string(mesh_) + more);
    }

    GltfBuilder builder_;
    int mesh_ = 0;
};

/// The boxes of all objects, by their paths.
std::map<std::string, Aabb3> boxes(const Scene& scene) {
    std::map<std::string, Aabb3> result;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].geometries.empty()) continue;
        Aabb3 box = Aabb3::empty();
        for (const std::uint32_t geometry : scene.nodes[i].geometries)
            for (const Vec3& point : scene.geometries[geometry].points) box = merged(box, Aabb3{point, point});
        result[path(scene, i)] = box;
    }
    return result;
}

void expect_box(const std::map<std::string, Aabb3>& all, const std::string& name, const Vec3& half) {
    const auto found = all.find(name);
    ASSERT_NE(found, all.end()) << name;
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(found->second.max[i], half[i], 0.006f * half[i]) << name;
        EXPECT_NEAR(found->second.min[i], -half[i], 0.006f * half[i]) << name;
    }
}

TEST_F(GltfColliders, OfKhronos) {
    const auto collider = [](const std::string& geometry) {
        return R"(,"extensions":{"KHR_physics_rigid_bodies":{"collider":{"geometry":{)" + geometry + "}}}}";
    };
    add("Box", collider("\"shape\":0"));
    add("Ball", collider("\"shape\":1"));
    add("Pill", collider("\"shape\":2"));
    add("Cone", collider("\"shape\":3"));
    add("Hull", collider("\"node\":4,\"convexHull\":true"));
    add("Zone", R"(,"extensions":{"KHR_physics_rigid_bodies":{"trigger":{"geometry":{"shape":0}}}})");
    add("Drawn alone", "");
    builder_.add_node("Body", R"(,"extensions":{"KHR_physics_rigid_bodies":{"motion":{}}})");
    builder_.add_text(R"(,"extensions":{"KHR_implicit_shapes":{"shapes":[{"type":"box","box":{"size":[2,4,6]}},
        {"type":"sphere","sphere":{"radius":3}},
        {"type":"capsule","capsule":{"height":4,"radiusBottom":1,"radiusTop":1}},
        {"type":"cylinder","cylinder":{"height":4,"radiusBottom":2,"radiusTop":0}}]}})");
    const Scene scene = read();
    const auto all = boxes(scene);
    EXPECT_EQ(all.size(), 5u) << "neither the trigger nor the mesh without a collider";
    expect_box(all, "Box", {1, 2, 3});
    expect_box(all, "Ball", {3, 3, 3});
    expect_box(all, "Pill", {1, 3, 1});
    expect_box(all, "Cone", {2, 2, 2});
    expect_box(all, "Hull", {5, 5, 5});
    EXPECT_EQ(scene.warnings.back(),
              "the file has colliders of its own: these are read, and not the meshes that are drawn");
    EXPECT_TRUE(scene.nodes.back().is_body);
    EXPECT_EQ(boxes(read({.ignore_colliders = true})).size(), 7u);
}

TEST_F(GltfColliders, OfOmi) {
    const auto body = [](const std::string& text) { return R"(,"extensions":{"OMI_physics_body":{)" + text + "}}"; };
    add("Box", body(R"("collider":{"shape":0})"));
    add("Mesh", body(R"("motion":{"type":"dynamic"},"collider":{"shape":1})"));
    add("Old pill", body(R"("collider":{"shape":2})"));
    add("Trigger", body(R"("trigger":{"shape":0})"));
    add("Parent", body(R"("collider":{"shape":-1})"));
    builder_.add_text(R"(,"extensions":{"OMI_physics_shape":{"shapes":[{"type":"box"},
        {"type":"convex","convex":{"mesh":0}},{"type":"capsule","capsule":{"height":4,"radius":1}}]}})");
    const auto all = boxes(read());
    EXPECT_EQ(all.size(), 3u);
    expect_box(all, "Box", {0.5f, 0.5f, 0.5f});
    expect_box(all, "Mesh", {5, 5, 5});
    expect_box(all, "Old pill", {1, 2, 1});
}

TEST_F(GltfColliders, OfTheOldExtensionOfOmi) {
    add("Sphere", R"(,"extensions":{"OMI_collider":{"collider":0}})");
    add("Pill", R"(,"extensions":{"OMI_collider":{"collider":1}})");
    add("Trigger", R"(,"extensions":{"OMI_collider":{"collider":2}})");
    builder_.add_text(R"(,"extensions":{"OMI_collider":{"colliders":[{"type":"sphere","radius":2},
        {"type":"capsule","radius":1,"height":6},{"type":"box","isTrigger":true}]}})");
    const auto all = boxes(read());
    EXPECT_EQ(all.size(), 2u);
    expect_box(all, "Sphere", {2, 2, 2});
    expect_box(all, "Pill", {1, 3, 1});
}

TEST_F(GltfColliders, ByExtras) {
    add("Ball", R"(,"extras":{"collision":"sphere"})");
    add("Box", R"(,"extras":{"collision":"box"})");
    add("Leaves", R"(,"extras":{"collision":"none"})");
    add("Other", "");
    const auto all = boxes(read());
    EXPECT_EQ(all.size(), 2u);
    expect_box(all, "Box", {5, 5, 5});
    expect_box(all, "Ball", Vec3(5 * std::sqrt(3.0f)));
}

TEST_F(GltfColliders, WithoutCollisionAloneTheOthersStay) {
    add("Leaves", R"(,"extras":{"collision":false})");
    add("Trunk", "");
    const auto all = boxes(read());
    EXPECT_EQ(all.size(), 1u);
    expect_box(all, "Trunk", {5, 5, 5});
}

TEST_F(GltfColliders, BadOnesAreNamed) {
    add("A", R"(,"extensions":{"OMI_physics_body":{"collider":{"shape":0}}})");
    GltfBuilder good = builder_;
    builder_.add_text(R"(,"extensions":{"OMI_physics_shape":{"shapes":[{"type":"blob"}]}})");
    EXPECT_EQ(complaint(), "shapes[0].type: a known shape was expected");
    builder_ = good;
    builder_.add_text(R"(,"extensions":{"OMI_physics_shape":{"shapes":[{"type":"sphere","sphere":{"radius":-1}}]}})");
    EXPECT_EQ(complaint(), "shapes[0].sphere: a size above zero was expected");
    builder_ = good;
    builder_.add_text(R"(,"extensions":{"OMI_physics_shape":{"shapes":[{"type":"convex","convex":{"mesh":7}}]}})");
    EXPECT_EQ(complaint(), "shapes[0].mesh: index 7 is out of range (1 exist)");
    builder_ = good;
    EXPECT_EQ(complaint(), "nodes[0].shape: index 0 is out of range (0 exist)");
}

TEST_F(GltfColliders, HullsOfBadMeshesAreNamed) {
    const int points = builder_.add_points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int indices = builder_.add_indices({{0, 1, 7}});
    const int bad = builder_.add_mesh("Bad", GltfBuilder::primitive(points, indices));
    builder_.add_node("A", ",\"mesh\":" + std::to_string(bad) + R"(,"extras":{"collision":"convex"})");
    EXPECT_EQ(complaint(), "mesh 'Bad': index 7 is out of range (3 vertices)");
}

TEST(ColliderNames, OfUnrealAndGodot) {
    for (const char* name : {"UCX_Crate", "UBX_Crate_01", "USP_a", "UCP_a", "Crate-convcol", "Crate-convcolonly.001"})
        EXPECT_EQ(detail::collider_name(name), ColliderName::convex) << name;
    for (const char* name : {"Crate-col", "Crate-colonly", "Crate-col_02", "Crate-colonly.001"})
        EXPECT_EQ(detail::collider_name(name), ColliderName::mesh) << name;
    for (const char* name : {"", "UCX_", "Crate", "ucx_crate", "Crate col", "Protocol", "Crate-column", "01"})
        EXPECT_EQ(detail::collider_name(name), std::nullopt) << name;
    for (const char* name : {"UCX_Crate_01", "UCX_Crate", "Crate-col", "Crate-convcolonly.001", "Crate"})
        EXPECT_EQ(detail::body_name(name), "Crate") << name;
}

TEST_F(GltfColliders, ByNamesInAnyFormat) {
    const std::string box =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n";  // not convex as a mesh: a corner and a fan
    const Result<Scene> scene = read_scene(write("a.obj", box + "o UCX_Crate_01\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 5\n"
                                                                "o Crate\nf 1 2 5\n"));
    ASSERT_TRUE(scene) << scene.problem().message;
    const auto all = boxes(*scene);
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all.begin()->first, "UCX_Crate_01");
    EXPECT_EQ(scene->warnings.back(), "1 node is a collider by name, such as 'UCX_Crate_01': 1 other is left out");
}

}  // namespace
}  // namespace abut
