// Walk meshes from files: made in the test, and selected by name.

#include "gltf_builder.hpp"
#include <abut/io/read_scene.hpp>
#include <abut/io/read_walk_mesh.hpp>
#include <abut/math/dvec.hpp>
#include <abut/walk/file.hpp>

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using test::GltfBuilder;
using test::Triangles;

/// A square from 0 to 1 in x and z, facing up.
Triangles tile() {
    return {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 2, 1}, {0, 3, 2}}};
}

class ReadWalkMesh : public test::SceneFiles {
protected:
    WalkMesh read(const std::string& file, std::string_view name = {}) const {
        Result<WalkMesh> mesh = read_walk_mesh(folder() / file, name);
        EXPECT_TRUE(mesh) << (mesh ? "" : mesh.problem().message);
        return mesh ? *std::move(mesh) : *WalkMesh::build(tile().points, tile().triangles);
    }
    std::string complaint(const std::string& file, std::string_view name = {}) const {
        const Result<WalkMesh> mesh = read_walk_mesh(folder() / file, name);
        return mesh ? std::string() : mesh.problem().message;
    }
    /// A mesh of points and normals, with the given indices of their accessors.
    static int add_with_normals(GltfBuilder& builder, const std::string& name, int points, int normals, int indices) {
        return builder.add_mesh(name, "{\"attributes\":{\"POSITION\":" + std::to_string(points) + ",\"NORMAL\":" +
                                          std::to_string(normals) + "},\"indices\":" + std::to_string(indices) + "}");
    }
};

/// Level with Floor, Bridge (mesh "Planks" of two parts), Room/NavMesh and a crate.
std::string level() {
    GltfBuilder builder;
    const int floor = builder.add_mesh("Tile", tile());
    const int points = builder.add_points(tile().points);
    const int first = builder.add_indices({{0, 2, 1}}), second = builder.add_indices({{0, 3, 2}});
    const int planks = builder.add_mesh(
        "Planks", GltfBuilder::primitive(points, first) + "," + GltfBuilder::primitive(points, second));
    const int box = builder.add_mesh("Box", test::box_triangles({1, 1, 1}));
    builder.add_node("Level", ",\"children\":[1,2,3,5]");
    builder.add_node("Floor", floor, {0, 0, 0});
    builder.add_node("Bridge", planks, {1, 0, 0});
    builder.add_node("Room", ",\"children\":[4],\"translation\":[0,5,0]");
    builder.add_node("NavMesh", ",\"mesh\":" + std::to_string(floor) + ",\"scale\":[3,1,2]");
    builder.add_node("Crate", box, {9, 9, 9});
    return builder.text();
}

TEST_F(ReadWalkMesh, TakesAllWithoutAName) {
    write("level.gltf", level());
    const WalkMesh mesh = read("level.gltf");
    EXPECT_EQ(mesh.triangles().size(), 2u + 2 + 2 + 12);
    EXPECT_EQ(mesh.report().components, 3u) << described(mesh.report());
    EXPECT_EQ(bounds(mesh), (Aabb3{{0, 0, 0}, {10, 10, 10}}));
}

TEST_F(ReadWalkMesh, TakesWhatANameDescribes) {
    write("level.gltf", level());
    const Aabb3 nav{{0, 5, 0}, {3, 5, 2}}, floor{{0, 0, 0}, {1, 0, 1}}, bridge{{1, 0, 0}, {2, 0, 1}};
    for (const char* name : {"NavMesh", "Level/Room/NavMesh", "Nav*", "*/Room/*", "NavMes?", "Level/Room*"}) {
        EXPECT_EQ(bounds(read("level.gltf", name)), nav) << name;
        EXPECT_EQ(read("level.gltf", name).triangles().size(), 2u) << name;
    }
    EXPECT_EQ(bounds(read("level.gltf", "Floor")), floor);
    EXPECT_EQ(bounds(read("level.gltf", "Planks")), bridge) << "by the mesh's name, all of its parts";
    EXPECT_EQ(read("level.gltf", "Planks").triangles().size(), 2u);
    EXPECT_EQ(read("level.gltf", "Tile").report().components, 2u) << "a mesh that is shown twice";
    EXPECT_EQ(read("level.gltf", "?????").triangles().size(), 2u + 12) << "Floor and Crate";
    EXPECT_EQ(read("level.gltf", "Level/*oo*").triangles().size(), 4u) << "Floor and Room/NavMesh";
    EXPECT_EQ(read("level.gltf", "*").triangles().size(), 18u);
}

TEST_F(ReadWalkMesh, TellsTheNamesThatThereAre) {
    write("level.gltf", level());
    EXPECT_EQ(complaint("level.gltf", "Navmesh"),
              "nothing in it is named 'Navmesh'; there are 'Level/Bridge' (mesh 'Planks'), 'Level/Crate' (mesh 'Box'), "
              "'Level/Floor' (mesh 'Tile'), 'Level/Room/NavMesh' (mesh 'Tile')");
    EXPECT_NE(complaint("level.gltf", "Level"), "") << "the node above them has no triangles itself";
    std::string many = "# of one triangle each\n";
    for (int i = 0; i < 20; ++i)
        many += "o part" + std::to_string(10 + i) + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\n";
    write("many.obj", many);
    const std::string message = complaint("many.obj", "x");
    EXPECT_NE(message.find("'part10', 'part11'"), std::string::npos) << message;
    EXPECT_TRUE(message.ends_with("'part21' and 8 more")) << message;
}

TEST_F(ReadWalkMesh, KeepsNormalsAndTakesThemAlong) {
    GltfBuilder builder;
    const Vec3 slanted(0.6f, 0.8f, 0);
    const int points = builder.add_points(tile().points), normals = builder.add_points({4, slanted}),
              indices = builder.add_indices(tile().triangles);
    const int mesh = add_with_normals(builder, "Tile", points, normals, indices);
    const std::string is_mesh = ",\"mesh\":" + std::to_string(mesh);
    builder.add_node("Plain", is_mesh);
    builder.add_node("Turned", is_mesh + ",\"rotation\":[0,0,0.70710678,0.70710678]");
    builder.add_node("Scaled", is_mesh + ",\"scale\":[3,4,1]");
    builder.add_node("Mirrored", is_mesh + ",\"scale\":[-1,1,1]");
    write("tile.gltf", builder.text());
    const auto normal = [&](const char* name) {
        const WalkMesh read_mesh = read("tile.gltf", name);
        return DVec<3>(read_mesh.smooth_normal({0, {0.25f, 0.25f, 0.5f}}));
    };
    EXPECT_LT(length(normal("Plain") - DVec<3>(0.6, 0.8, 0)), 1e-6);
    EXPECT_LT(length(normal("Turned") - DVec<3>(-0.8, 0.6, 0)), 1e-6);
    EXPECT_LT(length(normal("Scaled") - normalized(DVec<3>(0.6 / 3, 0.8 / 4, 0))), 1e-6);
    EXPECT_LT(length(normal("Mirrored") - DVec<3>(-0.6, 0.8, 0)), 1e-6);
    const WalkMesh mirrored = read("tile.gltf", "Mirrored");
    EXPECT_EQ(mirrored.normal({0, {1, 0, 0}}), Vec3(0, 1, 0)) << "its triangles face up still";

    const Result<Scene> scene = read_scene(folder() / "tile.gltf");
    ASSERT_TRUE(scene);
    EXPECT_TRUE(scene->geometries[0].normals.empty()) << "no option requested them";
}

TEST_F(ReadWalkMesh, HasNormalsOfItsOwnWhereSomeAreMissing) {
    GltfBuilder builder;
    const int points = builder.add_points(tile().points), normals = builder.add_points({4, Vec3(0.6f, 0.8f, 0)}),
              indices = builder.add_indices(tile().triangles);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const int three = builder.add_points({3, Vec3(0, 1, 0)}), none = builder.add_points({4, Vec3(0, nan, 0)});
    builder.add_node("With", add_with_normals(builder, "With", points, normals, indices), {0, 0, 0});
    builder.add_node("Without", builder.add_mesh("Without", tile()), {1, 0, 0});
    builder.add_node("TooFew", add_with_normals(builder, "TooFew", points, three, indices), {2, 0, 0});
    builder.add_node("NoNumber", add_with_normals(builder, "NoNumber", points, none, indices), {3, 0, 0});
    write("tiles.gltf", builder.text());
    for (const char* name : {"With*", "TooFew", "NoNumber", "Without"})
        EXPECT_EQ(read("tiles.gltf", name).smooth_normal({0, {1, 0, 0}}), Vec3(0, 1, 0)) << name;
    EXPECT_NE(read("tiles.gltf", "With").smooth_normal({0, {1, 0, 0}}), Vec3(0, 1, 0));
    const Result<Scene> scene = read_scene(folder() / "tiles.gltf", walk_mesh_options);
    ASSERT_TRUE(scene);
    EXPECT_EQ(scene->warnings,
              (std::vector<std::string>{"mesh 'TooFew': its normals are left out: 3 of 4 vertices",
                                        "mesh 'NoNumber': its normals are left out: that of vertex 0 is not finite"}));
}

TEST_F(ReadWalkMesh, ReadsWhatAssimpReads) {
    write("floor.obj",
          "o floor\nv 0 0 0\nv 4 0 0\nv 4 0 4\nv 0 0 4\nvn 0.6 0.8 0\nf 4//1 3//1 2//1 1//1\n"
          "o wall\nv 0 0 0\nv 0 3 0\nv 4 3 0\nv 4 0 0\nvn 0 0 1\nf 5//2 6//2 7//2 8//2\n");
    const WalkMesh floor = read("floor.obj", "floor");
    EXPECT_EQ(floor.triangles().size(), 2u);
    EXPECT_LT(length(DVec<3>(floor.smooth_normal({0, {1, 0, 0}})) - DVec<3>(0.6, 0.8, 0)), 1e-6);
    EXPECT_EQ(read("floor.obj").report().components, 1u);
    write("triangle.stl",
          "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
          "endloop\nendfacet\nendsolid a\n");
    EXPECT_EQ(read("triangle.stl").triangles().size(), 1u);
}

TEST_F(ReadWalkMesh, MendsTrianglesWithoutArea) {
    // Three collinear corners, where two squares share an edge with one.
    const std::string points = "v 0 0 0\nv 2 0 0\nv 2 0 1\nv 1 0 1\nv 0 0 1\nv 2 0 2\nv 1 0 2\nv 0 0 2\n";
    write("flat.obj", "o floor\n" + points + "f 1 5 3\nf 1 3 2\nf 3 5 4\nf 4 5 8\nf 4 8 7\nf 3 4 7\nf 3 7 6\n");
    const WalkMesh flat = read("flat.obj");
    EXPECT_EQ(flat.report().flat, 1u) << described(flat.report());
    EXPECT_EQ(flat.report().border, 7u);
    EXPECT_EQ(flat.report().components, 1u);
    write("polygon.obj", "o floor\n" + points + "f 2 1 5 4 3\nf 4 5 8 7\nf 3 4 7 6\n");
    const WalkMesh polygon = read("polygon.obj");
    EXPECT_EQ(polygon.report().components, 1u) << described(polygon.report());
    EXPECT_EQ(polygon.report().border, 7u);
}

TEST_F(ReadWalkMesh, ReadsBakedOnes) {
    write("level.gltf", level());
    const WalkMesh mesh = read("level.gltf", "NavMesh");
    const std::vector<std::byte> bytes = save(mesh);
    write("nav.walk", std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    EXPECT_EQ(save(read("nav.walk")), bytes);
    EXPECT_EQ(complaint("nav.walk", "NavMesh"), "a baked walk mesh has no names in it");
    write("cut.walk", std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size() - 1));
    EXPECT_EQ(complaint("cut.walk"), "the walk mesh is damaged: its checksum is wrong");
}

TEST_F(ReadWalkMesh, RefusesInALine) {
    EXPECT_EQ(complaint("none.gltf"), "no such file");
    write("text.gltf", "no scene");
    EXPECT_NE(complaint("text.gltf"), "");
    write("nan.obj", "o a\nv nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_NE(complaint("nan.obj"), "");
    write("line.obj", "o a\nv 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    EXPECT_EQ(complaint("line.obj"), "no triangle of the walk mesh has an area");
    GltfBuilder builder;
    builder.add_node("Nothing", ",\"mesh\":" + std::to_string(builder.add_mesh("Tile", tile())) + ",\"scale\":[0,0,0]");
    builder.add_node("Far", ",\"mesh\":0,\"scale\":[1e300,1,1]");
    write("scaled.gltf", builder.text());
    EXPECT_EQ(complaint("scaled.gltf", "Nothing"), "all objects are scaled to nothing");
    EXPECT_EQ(complaint("scaled.gltf", "Far"), "object 'Far': its transform takes it out of the range of floats");
}

}  // namespace
}  // namespace abut
