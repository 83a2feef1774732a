// `abut hull` as a command line.

#include "tool_runs.hpp"
#include <abut/bake/solid.hpp>
#include <abut/io/read_scene.hpp>
#include <abut/shape/weld.hpp>

#include <cmath>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class HullVerb : public test::ToolRuns {
protected:
    Json hull(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "hull");
        return json_of(std::move(arguments), 0);
    }
};

/// Boxes with edges of length 1 at x = 0 and x = 4, the second one mirrored.
std::string two_boxes() {
    GltfBuilder builder;
    const int box = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    builder.add_node("Left", box);
    builder.add_node("Right", ",\"mesh\":0,\"translation\":[4,0,0],\"scale\":[-1,1,1]");
    return builder.text();
}

TEST_F(HullVerb, HoldsAllObjectsInTheWorld) {
    const std::string file = write("two.gltf", two_boxes()).string();
    for (const char* name : {"hull.gltf", "hull.glb", "hull.obj"}) {
        const Json json = hull({file, "-o", out(name)});
        EXPECT_EQ(json["output"], out(name));
        ASSERT_EQ(json["hulls"].size(), 1u);
        const Json& one = json["hulls"][0];
        EXPECT_EQ(one["name"], "two");
        EXPECT_EQ(one["points"], 16);
        EXPECT_EQ(one["vertices"], 8);
        EXPECT_EQ(one["faces"], 6);
        EXPECT_EQ(one["volume"], 5);
        EXPECT_EQ(one["area"], 22);
        EXPECT_EQ(one["added"], 0);
        EXPECT_EQ(one["flat"], false);
        for (const char* stage : {"read", "build", "write"}) EXPECT_TRUE(json["seconds"][stage].is_number()) << stage;

        const Result<Scene> scene = read_scene(out(name));
        ASSERT_TRUE(scene) << scene.problem().message;
        ASSERT_EQ(scene->geometries.size(), 1u);
        const Welded welded = weld(scene->geometries[0].points, scene->geometries[0].triangles);
        EXPECT_TRUE(is_convex_solid(welded.points, welded.triangles));
        EXPECT_DOUBLE_EQ(signed_volume(welded.points, welded.triangles), 5);
    }
}

TEST_F(HullVerb, OfEachObjectIfRequested) {
    const std::string file = write("two.gltf", two_boxes()).string();
    const Json json = hull({file, "-o", out("hulls.glb"), "--each"});
    ASSERT_EQ(json["hulls"].size(), 2u);
    EXPECT_EQ(json["hulls"][0]["name"], "Left");
    EXPECT_EQ(json["hulls"][1]["name"], "Right");
    EXPECT_EQ(json["volume"], 2);
    EXPECT_EQ(json["vertices"], 16);
    const Result<Scene> scene = read_scene(out("hulls.glb"));
    ASSERT_TRUE(scene);
    ASSERT_EQ(scene->nodes.size(), 2u);
    EXPECT_EQ(scene->nodes[1].name, "Right");
    const Ran ran = run({"hull", file, "-o", out("hulls.glb"), "--each"});
    EXPECT_NE(ran.out.find("Left"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("2 hulls"), std::string::npos) << ran.out;
}

TEST_F(HullVerb, HasAtMostTheRequestedCorners) {
    GltfBuilder builder;
    test::Triangles ball;
    for (int x = -4; x <= 4; ++x)
        for (int y = -4; y <= 4; ++y)
            for (int z = -4; z <= 4; ++z)
                if (x * x + y * y + z * z <= 25) ball.points.emplace_back(x, y, z);
    for (std::uint32_t i = 0; i + 2 < ball.points.size(); i += 3) ball.triangles.emplace_back(i, i + 1, i + 2);
    builder.add_node("Ball", builder.add_mesh("Ball", ball));
    const std::string file = write("ball.gltf", builder.text()).string();
    const Json all = hull({file, "-o", out("ball.obj")})["hulls"][0];
    const Json few = hull({file, "-o", out("ball.obj"), "--max-vertices", "12"})["hulls"][0];
    EXPECT_GT(all["vertices"], 12);
    EXPECT_LE(few["vertices"], 12);
    EXPECT_GT(few["added"], 0);
    EXPECT_NEAR(few["volume"].get<double>() - few["added"].get<double>(), all["volume"].get<double>(), 1e-3);
    EXPECT_EQ(refusal({"hull", file, "-o", out("ball.obj"), "--max-vertices", "3"}),
              "abut: --max-vertices: '3' is not a whole number from 4 to 1000000");
}

TEST_F(HullVerb, WhatIsFlatHasTwoSides) {
    GltfBuilder builder;
    builder.add_node("Sheet", builder.add_mesh("Sheet", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
    const Json json = hull({write("sheet.gltf", builder.text()).string(), "-o", out("sheet.gltf.obj")});
    EXPECT_EQ(json["hulls"][0]["flat"], true);
    EXPECT_EQ(json["hulls"][0]["faces"], 2);
    EXPECT_EQ(json["volume"], 0);
}

TEST_F(HullVerb, RefusesInOneLine) {
    const std::string file = write("two.gltf", two_boxes()).string();
    const auto refused = [&](const std::string& mesh, const std::string& output) {
        return refusal({"hull", mesh, "-o", output});
    };
    EXPECT_EQ(refused(file, "hull.stl"), "abut: hull.stl: doesn't end in .gltf, .glb or .obj");
    EXPECT_EQ(refused(file, out("none/hull.obj")),
              "abut: " + out("none/hull.obj") + ": can't be written: No such file or directory");
    EXPECT_EQ(refused(file, file), "abut: " + file + ": is the mesh itself, and would be overwritten");
    EXPECT_EQ(refused(out("none.glb"), out("hull.obj")), "abut: " + out("none.glb") + ": no such file");
    EXPECT_TRUE(refused(write("empty.glb", "").string(), out("hull.obj")).ends_with(": is empty"));
    EXPECT_TRUE(
        refused(write("plan.svg", "<svg/>").string(), out("hull.obj")).ends_with(": is a 2D level, and has no meshes"));
    EXPECT_EQ(refusal({"hull", file}), "abut: --output is required; `abut help hull` explains it");

    GltfBuilder nan;
    nan.add_node("Box", nan.add_mesh("Box", box_triangles({NAN, 1, 1})));
    EXPECT_NE(refused(write("nan.gltf", nan.text()).string(), out("hull.obj")).find("not finite"), std::string::npos);
    GltfBuilder far;
    far.add_mesh("Box", box_triangles({1, 1, 1}));
    far.add_node("Box", ",\"mesh\":0,\"scale\":[1e39,1,1]");
    EXPECT_TRUE(refused(write("far.gltf", far.text()).string(), out("hull.obj"))
                    .ends_with(": object 'Box': its transform takes it out of the range of floats"));
    GltfBuilder none;
    none.add_mesh("Box", box_triangles({1, 1, 1}));
    none.add_node("Box", ",\"mesh\":0,\"scale\":[0,0,0]");
    EXPECT_TRUE(refused(write("none.gltf", none.text()).string(), out("hull.obj"))
                    .ends_with(": all objects are scaled to nothing"));
    GltfBuilder line;
    line.add_mesh("Box", box_triangles({1, 1, 1}));
    line.add_node("Box", ",\"mesh\":0,\"scale\":[1,0,0]");
    EXPECT_TRUE(refused(write("line.gltf", line.text()).string(), out("hull.obj"))
                    .ends_with("all its points are collinear, so that its hull would be a segment"));
    EXPECT_FALSE(std::filesystem::exists(out("hull.obj"))) << "nothing is written";
}

}  // namespace
}  // namespace abut
