// Reads whole files: scenes or problems.

#include "gltf_builder.hpp"
#include <abut/io/read_scene.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;

class ReadScene : public test::SceneFiles {
protected:
    /// The problem of a file with this content; empty if there is none.
    std::string complaint(const std::string& name, std::string_view content, const ReadOptions& options = {}) {
        const Result<Scene> scene = read_scene(write(name, content), options);
        return scene ? std::string() : scene.problem().message;
    }
    /// The problem of these bytes in memory. It must equal that of a file unless it depends on the source.
    static std::string complaint_in_memory(std::string_view extension, std::string_view content) {
        const Result<Scene> scene = read_scene(test::bytes_of(content), extension);
        return scene ? std::string() : scene.problem().message;
    }
};

std::string box_scene() {
    GltfBuilder builder;
    builder.add_node("Crate", builder.add_mesh("Box", box_triangles({1, 1, 1})), {0, 2, 0});
    return builder.text();
}

TEST_F(ReadScene, ReadsABox) {
    const Result<Scene> scene = read_scene(write("box.gltf", box_scene()));
    ASSERT_TRUE(scene) << scene.problem().message;
    ASSERT_EQ(scene->nodes.size(), 1u);
    EXPECT_EQ(path(*scene, 0), "Crate");
    EXPECT_EQ(scene->nodes[0].local[3][1], 2.0);
    ASSERT_EQ(scene->geometries.size(), 1u);
    EXPECT_EQ(scene->geometries[0].points.size(), 8u);
    EXPECT_EQ(scene->geometries[0].triangles.size(), 12u);
    EXPECT_TRUE(scene->warnings.empty());
}

TEST_F(ReadScene, ReadsTheSameFromMemoryFromGlbAndWithABinBesideIt) {
    GltfBuilder builder;
    builder.add_node("Crate", builder.add_mesh("Box", box_triangles({1, 2, 3})), {0, 2, 0});
    write("the box.bin",
          std::string_view(reinterpret_cast<const char*>(builder.bytes().data()), builder.bytes().size()));
    const Result<Scene> scenes[] = {
        read_scene(write("a.gltf", builder.text())), read_scene(write("b.GLB", builder.glb())),
        read_scene(write("c.gltf", builder.text("the%20box.bin"))), read_scene(test::bytes_of(builder.glb()), ".glb")};
    for (const Result<Scene>& scene : scenes) {
        ASSERT_TRUE(scene) << scene.problem().message;
        EXPECT_EQ(scene->geometries[0].points, scenes[0]->geometries[0].points);
        EXPECT_EQ(scene->geometries[0].triangles, scenes[0]->geometries[0].triangles);
    }
}

TEST_F(ReadScene, ReadsOtherFormats) {
    const Result<Scene> obj = read_scene(write("two.obj",
                                               "o Left\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
                                               "o Right\nv 5 0 0\nv 6 0 0\nv 6 1 0\nf 5 6 7\n"));
    ASSERT_TRUE(obj) << obj.problem().message;
    std::vector<std::string> objects;
    for (std::size_t i = 0; i < obj->nodes.size(); ++i)
        if (!obj->nodes[i].geometries.empty()) objects.push_back(path(*obj, i));
    EXPECT_EQ(objects, (std::vector<std::string>{"Left", "Right"}));

    const Result<Scene> stl = read_scene(write("part.stl",
                                               "solid thing\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                               "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid thing\n"));
    ASSERT_TRUE(stl) << stl.problem().message;

    const Result<Scene> ply = read_scene(write("scan.ply",
                                               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                               "property float y\nproperty float z\nelement face 1\n"
                                               "property list uchar int vertex_indices\nend_header\n"
                                               "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
    ASSERT_TRUE(ply) << ply.problem().message;
    EXPECT_EQ(path(*ply, 0), "scan") << "a nameless root with geometry goes by the file's name";
}

TEST_F(ReadScene, SaysWhatIsWrongWithFilesThatAreNone) {
    const Result<Scene> missing = read_scene(folder() / "nowhere.glb");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.problem().code, ProblemCode::not_found);
    EXPECT_EQ(missing.problem().message, "no such file");

    const Result<Scene> directory = read_scene(folder());
    ASSERT_FALSE(directory);
    EXPECT_EQ(directory.problem().message, "is a directory");

    EXPECT_EQ(complaint("empty.glb", ""), "is empty");
    EXPECT_EQ(complaint("empty.obj", ""), "is empty");
    EXPECT_EQ(complaint("picture.png", "\x89PNG\r\n\x1a\n"), "'.png' is not a known scene format");
    EXPECT_EQ(complaint("noending", "abc"), "has no ending that names a format");
    EXPECT_EQ(complaint("picture.glb", "\x89PNG\r\n\x1a\n"), "not a binary glTF: it doesn't begin with 'glTF'");
    EXPECT_EQ(complaint("text.gltf", "hello"), "JSON: syntax error at byte 1");
    EXPECT_EQ(complaint("list.gltf", "[]"), "JSON: an object was expected");
    EXPECT_EQ(complaint("big.gltf", R"({"asset":{"version":"2.0"},"scene":1e999})"), "JSON: a number is too large");
    EXPECT_EQ(complaint("new.gltf", R"({"asset":{"version":"3.0"}})"), "glTF version 3.0 is unknown");
}

TEST_F(ReadScene, NoPrefixOfAGlbIsTakenForTheWhole) {
    GltfBuilder builder;
    builder.add_node("Crate", builder.add_mesh("Box", box_triangles({1, 1, 1})));
    const std::string whole = builder.glb();
    ASSERT_EQ(complaint_in_memory(".glb", whole), "");
    for (std::size_t size = 0; size < whole.size(); ++size)
        ASSERT_NE(complaint_in_memory(".glb", std::string_view(whole).substr(0, size)), "") << size << " bytes";
    EXPECT_EQ(complaint("cut.glb", std::string_view(whole).substr(0, 100)),
              "glTF container is truncated: 100 of " + std::to_string(whole.size()) + " bytes");
}

TEST_F(ReadScene, NamesTheVertexThatIsNotFinite) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        GltfBuilder builder;
        test::Triangles box = box_triangles({1, 1, 1});
        box.points[5].y = bad;
        builder.add_node("Crate", builder.add_mesh("Box", box));
        EXPECT_EQ(complaint("bad.glb", builder.glb()), "mesh 'Box', vertex 5: coordinate is not finite");
    }
    EXPECT_EQ(complaint("bad.obj", "o A\nv 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"),
              "mesh 'A', vertex 1: coordinate is not finite");
}

TEST_F(ReadScene, StrictNamesTheTriangleOfZeroArea) {
    GltfBuilder builder;
    test::Triangles box = box_triangles({1, 1, 1});
    box.triangles[7] = {2, 2, 3};
    builder.add_node("Crate", builder.add_mesh("Box", box));
    const ReadOptions strict{.strict = true};
    EXPECT_EQ(complaint("bad.glb", builder.glb(), strict), "mesh 'Box', triangle 7: zero area");
    EXPECT_EQ(complaint("line.obj", "o A\nv 0 0 0\nv 1 1 1\nv 3 3 3\nf 1 2 3\n", strict),
              "mesh 'A', triangle 0: zero area");
    EXPECT_EQ(complaint("square.obj", "o A\nv 0 0 0\nv 1 1 1\nv 3 3 3\nv 2 2 2\nf 1 2 3 4\n", strict),
              "mesh 'A', polygon 0: zero area");
}

// One such triangle once made the whole file a problem: 98 of 1,134 real ones.
TEST_F(ReadScene, LeavesTrianglesOfZeroAreaOutAndCountsThem) {
    GltfBuilder builder;
    test::Triangles box = box_triangles({1, 1, 1});
    box.triangles[7] = {2, 2, 3};
    box.triangles[9] = {0, 0, 0};
    builder.add_node("Crate", builder.add_mesh("Box", box));
    builder.add_node("Whole", builder.add_mesh("Whole", box_triangles({1, 1, 1})));
    builder.add_node("Line", builder.add_mesh("Line", test::Triangles{{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}}));
    const Result<Scene> scene = read_scene(write("some.glb", builder.glb()));
    ASSERT_TRUE(scene) << scene.problem().message;
    EXPECT_EQ(scene->geometries[0].triangles.size(), 10u);
    EXPECT_EQ(scene->geometries[0].left_out, 2u);
    ASSERT_EQ(scene->left_out.size(), 2u);
    EXPECT_EQ(scene->left_out[0].node, 0u);
    EXPECT_EQ(scene->left_out[0].triangles, 2u);
    EXPECT_EQ(scene->left_out[1].node, 2u);
    EXPECT_EQ(scene->left_out[1].triangles, 1u);
    EXPECT_TRUE(scene->nodes[2].geometries.empty()) << "an object without a shape";
    EXPECT_EQ(scene->warnings,
              (std::vector<std::string>{"3 triangles of zero area are left out, such as in 'Crate'",
                                        "1 object has no triangles but those, and so no shape: 'Line'"}));

    const Result<Scene> polygons =
        read_scene(write("some.obj", "o A\nv 0 0 0\nv 1 1 1\nv 3 3 3\nv 2 2 2\nv 1 0 0\nf 1 2 3 4\nf 1 2 5\n"));
    ASSERT_TRUE(polygons) << polygons.problem().message;
    ASSERT_EQ(polygons->left_out.size(), 1u);
    EXPECT_EQ(polygons->left_out[0].triangles, 1u) << "the polygon, not what it is cut into";

    EXPECT_EQ(complaint("line.obj", "o A\nv 0 0 0\nv 1 1 1\nv 3 3 3\nf 1 2 3\n"),
              "all triangles in it have zero area: 0 objects");
}

// Assimp opens files in the process's own folder if it reads bytes.
TEST_F(ReadScene, FromMemoryNoFileIsRead) {
    const std::string file = write("a.mtl", "newmtl red\nKd 1 0 0\n").string();
    EXPECT_EQ(complaint_in_memory(".obj", "mtllib " + file + "\no A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n"),
              "");
    EXPECT_NE(
        complaint_in_memory(".lws", "LWSC\n1\n\nLoadObject " +
                                        write("a.obj", "o A\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string() + "\n"),
        "");
}

TEST(ZeroArea, IsJudgedBesideTheLongestEdge) {
    EXPECT_TRUE(detail::has_zero_area({1, 2, 3}, {1, 2, 3}, {1, 2, 3}));
    EXPECT_TRUE(detail::has_zero_area({1, 2, 3}, {1, 2, 3}, {4, 5, 7}));
    EXPECT_TRUE(detail::has_zero_area({0, 0, 0}, {1, 1e-13f, 0}, {2, 0, 0}));
    EXPECT_FALSE(detail::has_zero_area({0, 0, 0}, {1, 1e-10f, 0}, {2, 0, 0}));
    EXPECT_FALSE(detail::has_zero_area({0, 0, 0}, {1e-20f, 0, 0}, {0, 1e-20f, 0}));
    EXPECT_FALSE(detail::has_zero_area({-3e38f, 0, 0}, {3e38f, 0, 0}, {0, 3e38f, 0}));
}

TEST_F(ReadScene, PolygonsWithCornersInARowAreFine) {
    // Assimp triangulates these such that one of the pieces has no area.
    const std::pair<const char*, float> polygons[] = {
        {"o A\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3 4\n", 1.0f},
        {"o A\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 0\nf 1 2 3 4 5\n", 4.0f}};
    for (const auto& [text, expected] : polygons) {
        const Result<Scene> scene = read_scene(write("row.obj", text));
        ASSERT_TRUE(scene) << scene.problem().message;
        EXPECT_TRUE(scene->warnings.empty());
        float area = 0;
        const Geometry& geometry = scene->geometries[0];
        for (const glm::uvec3& t : geometry.triangles) {
            const Vec3 u = geometry.points[t.y] - geometry.points[t.x];
            const Vec3 v = geometry.points[t.z] - geometry.points[t.x];
            area += 0.5f * std::abs(u.x * v.y - u.y * v.x);
        }
        EXPECT_FLOAT_EQ(area, expected);
    }
}

TEST_F(ReadScene, NamesTheIndexOutOfRange) {
    GltfBuilder builder;
    test::Triangles box = box_triangles({1, 1, 1});
    box.triangles[3] = {0, 1, 99};
    builder.add_node("Crate", builder.add_mesh("Box", box));
    EXPECT_EQ(complaint("bad.glb", builder.glb()), "mesh 'Box', triangle 3: index 99 is out of range (8 vertices)");
    EXPECT_NE(complaint("bad.obj", "o A\nv 0 0 0\nv 1 0 0\nf 1 2 9\n"), "");
}

TEST_F(ReadScene, RefusesScenesWithoutObjects) {
    EXPECT_EQ(complaint("none.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[]}],"scene":0})"),
              "no triangles in it: 0 objects");
    EXPECT_EQ(complaint("none.gltf", R"({"asset":{"version":"2.0"}})"), "no triangles in it: 0 objects");
    EXPECT_EQ(complaint("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "no triangles in it: 0 objects");
    GltfBuilder unused;
    unused.add_mesh("Box", box_triangles({1, 1, 1}));
    unused.add_node("Empty", "");
    EXPECT_EQ(complaint("unused.gltf", unused.text()), "no triangles in it: 0 objects");
}

TEST_F(ReadScene, RefusesNodesInACircle) {
    GltfBuilder builder;
    builder.add_node("Crate", builder.add_mesh("Box", box_triangles({1, 1, 1})));
    builder.add_node("A", ",\"children\":[2]");
    builder.add_node("B", ",\"children\":[1]");
    EXPECT_EQ(complaint("cycle.gltf", builder.text()), "node tree: node 'A' is part of a cycle");

    GltfBuilder self;
    self.add_node("Me", ",\"children\":[0]");
    EXPECT_EQ(complaint("self.gltf", self.text()), "node tree: node 'Me' is part of a cycle");

    GltfBuilder shared;
    shared.add_node("A", ",\"children\":[2]");
    shared.add_node("B", ",\"children\":[2]");
    shared.add_node("C", "");
    EXPECT_EQ(complaint("shared.gltf", shared.text()), "node tree: node 'C' has two parents, node 'A' and node 'B'");

    EXPECT_EQ(
        complaint("old.gltf", R"({"asset":{"version":"1.0"},"nodes":{"a":{"children":["b"]},"b":{"children":["a"]}}})"),
        "node tree: node 'a' is part of a cycle");
}

TEST_F(ReadScene, RefusesTreesThatAreTooDeep) {
    const auto chain = [](int depth) {
        GltfBuilder builder;
        const int mesh = builder.add_mesh("Box", box_triangles({1, 1, 1}));
        for (int i = 0; i + 1 < depth; ++i)
            builder.add_node("n" + std::to_string(i), ",\"children\":[" + std::to_string(i + 1) + "]");
        builder.add_node("n" + std::to_string(depth - 1), mesh);
        return builder.text();
    };
    EXPECT_EQ(complaint("limit.gltf", chain(1000)), "");
    EXPECT_EQ(complaint("over.gltf", chain(1001)), "node tree is 1001 deep; the limit is 1000, passed at node 'n1000'");
    EXPECT_EQ(complaint("deep.gltf", chain(100000)),
              "node tree is 100000 deep; the limit is 1000, passed at node 'n1000'");
}

TEST_F(ReadScene, NamesTheTransformThatIsNotFinite) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({1, 1, 1}));
    builder.add_node("Crate", mesh);
    builder.add_motion(0, "Fall", {0, 1}, {{0, 1, 0}, {0, std::numeric_limits<float>::infinity(), 0}});
    EXPECT_EQ(complaint("bad.glb", builder.glb()), "animation 'Fall', node 'Crate': key 1 is not finite");

    GltfBuilder backwards;
    backwards.add_node("Crate", backwards.add_mesh("Box", box_triangles({1, 1, 1})));
    backwards.add_motion(0, "Fall", {1, 0}, {{0, 1, 0}, {0, 0, 0}});
    EXPECT_EQ(complaint("bad.glb", backwards.glb()),
              "animation 'Fall', node 'Crate': key 1 is earlier than the one before");
}

TEST_F(ReadScene, NamesWithTheSamePathGetNumbers) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({1, 1, 1}));
    builder.add_node("Crate", mesh);
    builder.add_node("Crate", ",\"children\":[2,3]");
    builder.add_node("Lid", mesh);
    builder.add_node("Lid", mesh);
    builder.add_node("Crate", mesh);
    const Result<Scene> scene = read_scene(write("names.gltf", builder.text()));
    ASSERT_TRUE(scene) << scene.problem().message;
    std::vector<std::string> paths;
    for (std::size_t i = 0; i < scene->nodes.size(); ++i) paths.push_back(path(*scene, i));
    EXPECT_EQ(paths, (std::vector<std::string>{"Crate", "Crate#2", "Crate#2/Lid", "Crate#2/Lid#2", "Crate#3"}));
}

TEST_F(ReadScene, NodesWithOneNameMoveApart) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({1, 1, 1}));
    builder.add_node("Crate", mesh);
    builder.add_node("Crate", mesh);
    builder.add_motion(1, "Fall", {0, 1}, {{0, 0, 0}, {0, 8, 0}});
    const Result<Scene> scene = read_scene(write("names.gltf", builder.text()));
    ASSERT_TRUE(scene) << scene.problem().message;
    std::vector<glm::dmat4> matrices;
    world_matrices(*scene, 1, matrices);
    EXPECT_EQ(matrices[0][3][1], 0.0);
    EXPECT_EQ(matrices[1][3][1], 8.0);
}

TEST_F(ReadScene, WarnsOnceOfWhatItTakesDifferently) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({1, 1, 1}));
    const int points = builder.add_points({{0, 0, 0}, {1, 0, 0}});
    const int cloud =
        builder.add_mesh("Cloud", "{\"mode\":0,\"attributes\":{\"POSITION\":" + std::to_string(points) + "}}");
    builder.add_node("Trees", ",\"mesh\":" + std::to_string(mesh) + R"(,"extensions":{"EXT_mesh_gpu_instancing":{}})");
    for (int i = 0; i < 2; ++i) {
        builder.add_node("Person", ",\"skin\":0,\"mesh\":" + std::to_string(mesh));
        builder.add_node("Dust", cloud);
    }
    builder.add_text(R"(,"skins":[{"joints":[0]}])");
    const Result<Scene> scene = read_scene(write("odd.gltf", builder.text()));
    ASSERT_TRUE(scene) << scene.problem().message;
    EXPECT_EQ(scene->warnings, (std::vector<std::string>{
                                   "points and lines are left out: only triangles collide",
                                   "skinned meshes are posed as at the first time, and move with the root of their "
                                   "joints"}));
}

}  // namespace
}  // namespace abut
