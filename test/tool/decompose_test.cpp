// `abut decompose` as a command line.

#include "../../scenes/solid_meshes.hpp"
#include "../oracle/bake/part_quality.hpp"
#include "tool_runs.hpp"
#include <abut/io/read_scene.hpp>
#include <abut/io/write_obj.hpp>

#include <cmath>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class DecomposeVerb : public test::ToolRuns {
protected:
    Json decomposed(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "decompose");
        return json_of(std::move(arguments), 0);
    }

    std::string write_mesh(const std::string& name, const scenes::SolidMesh& mesh) const {
        return write(name, *write_obj(std::vector{Geometry{"mesh", mesh.points, mesh.triangles}})).string();
    }
    static std::vector<Polyhedron> parts_in(const std::string& file) {
        const Result<Scene> scene = read_scene(file);
        EXPECT_TRUE(scene) << (scene ? "" : scene.problem().message);
        std::vector<Polyhedron> parts;
        if (scene)
            for (const Geometry& geometry : scene->geometries) parts.push_back(*Polyhedron::build(geometry.points));
        return parts;
    }
};

/// A cube, and a box three times as long beside it.
scenes::SolidMesh boxes() {
    return scenes::of_cubes({{"# ###"}});
}

TEST_F(DecomposeVerb, WritesOneNodeAPart) {
    const scenes::SolidMesh mesh = boxes();
    const std::string file = write_mesh("boxes.obj", mesh);
    for (const char* name : {"parts.gltf", "parts.glb", "parts.obj"}) {
        const Json json = decomposed({file, "-o", out(name)});
        EXPECT_EQ(json["output"], out(name));
        EXPECT_EQ(json["triangles"], 40);
        EXPECT_EQ(json["closed"], true);
        ASSERT_EQ(json["parts"].size(), 2u);
        EXPECT_EQ(json["parts"][0]["name"], "boxes_0");
        EXPECT_EQ(json["parts"][0]["vertices"], 8);
        EXPECT_EQ(json["parts"][0]["faces"], 6);
        EXPECT_EQ(json["parts"][0]["fit"]["kind"], "box");
        EXPECT_EQ(json["vertices"], 16);
        EXPECT_NEAR(json["volume"].get<double>(), 4, 1e-5);
        EXPECT_NEAR(json["parts_volume"].get<double>(), 4, 1e-5);
        EXPECT_NEAR(json["extra"].get<double>(), 0, 1e-5);
        EXPECT_LT(json["uncovered"].get<double>(), 1e-5);
        EXPECT_EQ(json["repairs"]["triangles_turned"], 0);
        for (const char* stage : {"read", "repair", "decompose", "write"})
            EXPECT_TRUE(json["seconds"][stage].is_number()) << stage;

        const std::vector<Polyhedron> parts = parts_in(out(name));
        ASSERT_EQ(parts.size(), 2u);
        const oracle::PartQuality quality = oracle::quality_of(mesh.points, mesh.triangles, parts, 2000, 1);
        EXPECT_EQ(quality.uncovered, 0);
        EXPECT_LT(quality.extra, 0.01);
        EXPECT_LT(quality.missing, 0.01);
    }
}

TEST_F(DecomposeVerb, SaysWhatItDid) {
    const std::string file = write_mesh("boxes.obj", boxes());
    const Ran ran = run({"decompose", file, "-o", out("parts.glb")});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    for (const char* said : {"boxes_1: a box", "40 triangles: nothing to repair", "2, 16 vertices, at most 8 each",
                             "4 in the mesh, 4 in its parts", "s to read"})
        EXPECT_NE(ran.out.find(said), std::string::npos) << said << "\n" << ran.out;
}

TEST_F(DecomposeVerb, RepairsFirst) {
    scenes::SolidMesh mesh = boxes();
    int turned = 0;
    for (std::size_t i = 0; i + 1 < mesh.triangles.size(); i += 5, ++turned)
        std::swap(mesh.triangles[i].x, mesh.triangles[i].y);
    mesh.triangles.pop_back();
    const std::string file = write_mesh("broken.obj", mesh);
    const Json json = decomposed({file, "-o", out("parts.glb")});
    EXPECT_EQ(json["repairs"]["triangles_turned"], turned);
    EXPECT_EQ(json["repairs"]["holes_filled"], 1);
    EXPECT_EQ(json["closed"], true);
    EXPECT_NEAR(json["volume"].get<double>(), 4, 1e-5);
}

TEST_F(DecomposeVerb, KeepsItsLimits) {
    const std::string file = write_mesh("tube.obj", scenes::knotted_tube(24, 6));
    const Json few = decomposed({file, "-o", out("few.glb"), "--parts", "4", "--max-vertices", "12"});
    EXPECT_LE(few["parts"].size(), 4u);
    for (const Json& part : few["parts"]) EXPECT_LE(part["vertices"], 12);
    const Json rough = decomposed({file, "-o", out("rough.glb"), "--concavity", "0.5"});
    const Json fine = decomposed({file, "-o", out("fine.glb"), "--concavity", "0.1"});
    EXPECT_LT(rough["parts"].size(), fine["parts"].size());
    EXPECT_GT(rough["extra"], fine["extra"]);
}

TEST_F(DecomposeVerb, TakesObjectsWhereTheyStand) {
    GltfBuilder builder;
    builder.add_mesh("Box", box_triangles({1, 1, 1}));
    builder.add_node("Left", 0, {-5, 0, 0});
    builder.add_node("Right", ",\"mesh\":0,\"translation\":[5,0,0],\"scale\":[-2,1,1]");
    const Json json = decomposed({write("two.gltf", builder.text()).string(), "-o", out("parts.obj")});
    ASSERT_EQ(json["parts"].size(), 2u);
    EXPECT_NEAR(json["volume"].get<double>(), 24, 1e-4);
    EXPECT_EQ(json["repairs"]["triangles_turned"], 0) << "what is mirrored is turned as it is read";
}

TEST_F(DecomposeVerb, LeavesRoomsHollowIfRequested) {
    scenes::SolidMesh room = boxes();
    for (glm::uvec3& t : room.triangles) std::swap(t.y, t.z);
    const std::string file = write_mesh("room.obj", room);
    const Json solid = decomposed({file, "-o", out("parts.glb")});
    EXPECT_EQ(solid["closed"], true);
    EXPECT_NEAR(solid["volume"].get<double>(), 4, 1e-5);
    const Json walls = decomposed({file, "-o", out("parts.glb"), "--rooms"});
    EXPECT_EQ(walls["closed"], false);
    EXPECT_LT(walls["parts_volume"], 1) << "hardly more than walls";
}

TEST_F(DecomposeVerb, OpenMeshesHaveNoVolume) {
    GltfBuilder builder;
    builder.add_node("Sheet", builder.add_mesh("Sheet", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
    const std::string file = write("sheet.gltf", builder.text()).string();
    const Json json = decomposed({file, "-o", out("parts.obj")});
    EXPECT_EQ(json["closed"], false);
    EXPECT_TRUE(json["extra"].is_null());
    ASSERT_EQ(json["parts"].size(), 1u);
    EXPECT_EQ(json["parts"][0]["flat"], true);
    EXPECT_NE(run({"decompose", file, "-o", out("parts.obj")}).out.find("not closed"), std::string::npos);
}

TEST_F(DecomposeVerb, DrawsAPicture) {
    const std::string file = write_mesh("boxes.obj", boxes()), picture = out("parts.svg");
    decomposed({file, "-o", out("parts.glb"), "--picture", picture});
    const std::string svg = content(picture);
    EXPECT_TRUE(svg.starts_with("<svg")) << svg.substr(0, 100);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    std::size_t polygons = 0;
    for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1)) ++polygons;
    EXPECT_EQ(polygons, 6u) << "three sides of each box";
    decomposed({file, "-o", out("parts.glb"), "--picture", picture});
    EXPECT_EQ(content(picture), svg) << "the same bytes";
}

TEST_F(DecomposeVerb, RefusesInOneLine) {
    const std::string file = write_mesh("boxes.obj", boxes());
    const auto refused = [&](const std::vector<std::string>& more) { return refusal("decompose", file, more); };
    EXPECT_EQ(refused({"-o", "parts.ply"}), "abut: parts.ply: doesn't end in .gltf, .glb or .obj");
    EXPECT_EQ(refused({"-o", out("none/parts.obj")}),
              "abut: " + out("none/parts.obj") + ": can't be written: No such file or directory");
    EXPECT_EQ(refused({"-o", out("p.obj"), "--picture", out("none/p.svg")}),
              "abut: " + out("none/p.svg") + ": can't be written: No such file or directory");
    EXPECT_EQ(refused({"-o", out("p.obj"), "--parts", "0"}),
              "abut: --parts: '0' is not a whole number from 1 to 100000");
    EXPECT_EQ(refused({"-o", out("p.obj"), "--concavity", "2"}), "abut: --concavity: '2' is not a number from 0 to 1");
    EXPECT_EQ(refused({"-o", out("p.obj"), "--concavity", "nan"}),
              "abut: --concavity: 'nan' is not a number from 0 to 1");
    EXPECT_EQ(refused({"-o", out("p.obj"), "--max-vertices", "2.5"}),
              "abut: --max-vertices: '2.5' is not a whole number from 4 to 1000000");
    expect_bad_meshes_refused("decompose", out("p.glb"));
}

}  // namespace
}  // namespace abut
