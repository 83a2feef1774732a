// `abut cast` as a command line.

#include "tool_runs.hpp"

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class Cast : public test::ToolRuns {
protected:
    Json cast(std::vector<std::string> arguments, int code) const {
        arguments.insert(arguments.begin(), "cast");
        return json_of(std::move(arguments), code);
    }
};

/// Boxes with edges of length 1 at x = 0 and x = 4, and a sheet of two triangles at x = 8, across the x axis.
std::string row() {
    GltfBuilder builder;
    const int box = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    builder.add_node("Left", box, {0, 0, 0});
    builder.add_node("Right", box, {4, 0, 0});
    test::Triangles sheet;
    sheet.points = {{0, -3, -3}, {0, 3, -3}, {0, 3, 3}, {0, -3, 3}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    builder.add_node("Sheet", builder.add_mesh("Sheet", sheet), {8, 0, 0});
    return builder.text();
}

TEST_F(Cast, ReportsTheFirstHit) {
    const std::string file = write("row.gltf", row()).string();
    const Json json = cast({file, "--from", "-3,0,0", "--to", "9,0,0"}, 1);
    EXPECT_EQ(json["objects"], 3);
    EXPECT_EQ(json["clear"], false);
    ASSERT_EQ(json["hits"].size(), 1u) << "it ends at the first";
    const Json& hit = json["hits"][0];
    EXPECT_EQ(hit["object"], "Left");
    EXPECT_EQ(hit["distance"], 2.5);
    EXPECT_EQ(hit["travelled"], 2.5);
    EXPECT_EQ(hit["point"], Json({-0.5, 0.0, 0.0}));
    EXPECT_EQ(hit["normal"], Json({-1.0, 0.0, 0.0}));
    EXPECT_EQ(hit["started_inside"], false);
    EXPECT_EQ(json["end"], hit["point"]);
    for (const char* stage : {"read", "build", "cast"}) EXPECT_TRUE(json["seconds"][stage].is_number()) << stage;

    const Ran ran = run({"cast", file, "--from", "-3,0,0", "--to", "9,0,0"});
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.out.find("HIT: Left is in the way, 2.5 from (-3, 0, 0)"), std::string::npos) << ran.out;
}

TEST_F(Cast, IsClearWhereTheRayEndsBeforeOrPasses) {
    const std::string file = write("row.gltf", row()).string();
    EXPECT_EQ(cast({file, "--from", "1,0,0", "--to", "3,0,0"}, 0)["clear"], true);
    const Json json = cast({file, "--from", "-3,2,0", "--to", "7.5,2,0"}, 0);
    EXPECT_EQ(json["hits"].size(), 0u);
    EXPECT_EQ(json["end"], Json({7.5, 2.0, 0.0}));
    const Ran ran = run({"cast", file, "--from", "1,0,0", "--to", "3,0,0"});
    EXPECT_EQ(ran.code, 0);
    EXPECT_NE(ran.out.find("CLEAR: nothing between (1, 0, 0) and (3, 0, 0)"), std::string::npos) << ran.out;
}

TEST_F(Cast, OfAMeshNamesTheTriangle) {
    const std::string file = write("row.gltf", row()).string();
    EXPECT_EQ(cast({file, "--from", "9,-1,1", "--to", "7,-1,1"}, 1)["hits"][0]["part"], 1);
    const Json hit = cast({file, "--from", "9,1,-1", "--to", "7,1,-1"}, 1)["hits"][0];
    EXPECT_EQ(hit["part"], 0);
    EXPECT_EQ(hit["normal"], Json({1.0, 0.0, 0.0})) << "towards where the ray comes from";
}

TEST_F(Cast, ReportsAllHits) {
    const std::string file = write("row.gltf", row()).string();
    const Json json = cast({file, "--from", "-3,0.25,0", "--to", "9,0.25,0", "--all"}, 1);
    ASSERT_EQ(json["hits"].size(), 3u) << "each thing once, though the ray comes out of the boxes too";
    const char* names[] = {"Left", "Right", "Sheet"};
    const double travelled[] = {2.5, 6.5, 11}, distances[] = {2.5, 4, 4.5}, xs[] = {-0.5, 3.5, 8};
    for (std::size_t i = 0; i < 3; ++i) {
        const Json& hit = json["hits"][i];
        EXPECT_EQ(hit["object"], names[i]);
        EXPECT_EQ(hit["travelled"], travelled[i]);
        EXPECT_EQ(hit["distance"], distances[i]) << "from the hit before";
        EXPECT_EQ(hit["point"], Json({xs[i], 0.25, 0.0}));
    }
    EXPECT_EQ(json["end"], Json({9.0, 0.25, 0.0})) << "nothing stops it";
    EXPECT_EQ(cast({file, "--from", "-3,0.25,0", "--to", "7,0.25,0", "--all"}, 1)["hits"].size(), 2u);
    EXPECT_EQ(cast({file, "--from", "1,0,0", "--to", "3,0,0", "--all"}, 0)["clear"], true);
    const Ran ran = run({"cast", file, "--from", "-3,0.25,0", "--to", "9,0.25,0", "--all"});
    EXPECT_NE(ran.out.find("HIT: Left is in the way, 2.5 from (-3, 0.25, 0), and 2 things behind it"),
              std::string::npos)
        << ran.out;
    EXPECT_EQ(refusal({"cast", file, "--from", "-3,0,0", "--to", "9,0,0", "--all", "--bounces", "3"}),
              "abut: --bounces excludes --all; `abut help cast` explains it");
}

TEST_F(Cast, FromInsideSaysSo) {
    const std::string file = write("row.gltf", row()).string();
    const Json hit = cast({file, "--from", "-0.25,0,0", "--to", "1,0,0"}, 1)["hits"][0];
    EXPECT_EQ(hit["object"], "Left");
    EXPECT_EQ(hit["distance"], 0);
    EXPECT_EQ(hit["started_inside"], true);
}

TEST_F(Cast, BouncesBetweenMirrorsAndGoesOnBeyondTheTarget) {
    const std::string file = write("row.gltf", row()).string();
    // Back and forth between the boxes, whose faces are 3 apart.
    Json json = cast({file, "--from", "1,0,0", "--to", "1.5,0,0", "--bounces", "4"}, 1);
    ASSERT_EQ(json["hits"].size(), 5u) << "the last one isn't thrown back";
    for (std::size_t i = 0; i < 5; ++i) {
        const Json& hit = json["hits"][i];
        EXPECT_EQ(hit["object"], i % 2 == 0 ? "Right" : "Left");
        EXPECT_NEAR(hit["travelled"].get<double>(), 2.5 + 3 * static_cast<double>(i), 1e-5);
    }
    EXPECT_EQ(json["end"], json["hits"][4]["point"]);
    // Reflected by the right box at an angle, past the left one, and into the distance.
    json = cast({file, "--from", "2,0.4,0", "--to", "3.5,0.1,0", "--bounces", "9"}, 1);
    EXPECT_GE(json["hits"].size(), 1u);
    EXPECT_LT(json["hits"].size(), 10u);
    EXPECT_TRUE(json["end"].is_null());
    cast({file, "--from", "2,2,0", "--to", "2,3,0", "--bounces", "9"}, 0);
}

TEST_F(Cast, IsAtTheRequestedMoment) {
    // A door across the x axis goes up by 4 in a third of 10 seconds.
    GltfBuilder builder;
    const int node = builder.add_node("Door", builder.add_mesh("Door", box_triangles({0.5f, 0.5f, 0.5f})), {0, 0, 0});
    builder.add_motion(node, "open", {0, 3.3333333f}, {{0, 0, 0}, {0, 4, 0}});
    const std::string file = write("door.gltf", builder.text()).string();
    const auto line = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{file, "--from", "-3,0,0", "--to", "3,0,0"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    EXPECT_EQ(cast(line({}), 1)["time"], 0) << "the first moment";
    EXPECT_EQ(cast(line({"--time", "0.25"}), 1)["time"], 0.25);
    EXPECT_EQ(cast(line({"--time", "2"}), 0)["time"], 2);
    EXPECT_NEAR(cast(line({"--time", "3.334"}), 0)["time"].get<double>(), 3.3333333, 1e-6) << "as reports round it";
    const auto refused = [&](const std::string& from, const std::string& time) {
        return refusal({"cast", from, "--from", "-3,0,0", "--to", "3,0,0", "--time", time});
    };
    EXPECT_EQ(refused(file, "4"),
              "abut: " + file + ": --time: 4 s is not in the animation, which is from 0 s to 3.333 s");
    EXPECT_EQ(refused(file, "-1"),
              "abut: " + file + ": --time: -1 s is not in the animation, which is from 0 s to 3.333 s");
    EXPECT_EQ(refused(file, "now"), "abut: --time: 'now' is not a number of seconds");
    const std::string still = write("row.gltf", row()).string();
    EXPECT_EQ(refused(still, "1"), "abut: " + still + ": --time: nothing moves, so the first moment is the only one");
    EXPECT_EQ(cast({still, "--from", "-3,0,0", "--to", "9,0,0", "--time", "0"}, 1)["time"], 0);
}

TEST_F(Cast, DrawsAPicture) {
    const std::string file = write("row.gltf", row()).string(), picture = (folder() / "picture.svg").string();
    cast({file, "--from", "-3,0,0", "--to", "9,0,0", "-o", picture}, 1);
    const std::string svg = content(picture);
    EXPECT_TRUE(svg.starts_with("<svg")) << svg.substr(0, 100);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_NE(svg.find("#e11d48"), std::string::npos) << "the ray";
    cast({file, "--from", "-3,0,0", "--to", "9,0,0", "-o", picture}, 1);
    EXPECT_EQ(content(picture), svg) << "the same bytes";
    EXPECT_EQ(refusal({"cast", file, "--from", "-3,0,0", "--to", "9,0,0", "-o", folder().string()}),
              "abut: " + folder().string() + ": can't be written: it is a directory");
}

TEST_F(Cast, BadUsageIsRefused) {
    const std::string file = write("row.gltf", row()).string();
    const auto refused = [&](const std::string& from, const std::string& to) {
        return refusal({"cast", file, "--from", from, "--to", to});
    };
    const std::string no_point = "' is not a point, three numbers with commas between them: X,Y,Z";
    EXPECT_EQ(refused("1,2", "0,0,0"), "abut: --from: '1,2" + no_point);
    EXPECT_EQ(refused("0,0,0", "1,2,3,4"), "abut: --to: '1,2,3,4" + no_point);
    EXPECT_EQ(refused("0,0,0", "1,nan,3"), "abut: --to: '1,nan,3" + no_point);
    EXPECT_EQ(refused("0,0,0", ""), "abut: --to: '" + no_point);
    EXPECT_EQ(refused("1,2,3", "1,2,3"), "abut: --from and --to are the same place");
    EXPECT_EQ(refusal({"cast", file, "--from", "0,0,0", "--to", "1,0,0", "--bounces", "0"}),
              "abut: --bounces: '0' is not a whole number from 1 to 100000");
    refusal({"cast", file, "--from", "0,0,0"});
    refusal({"cast"});
    const std::string missing = (folder() / "missing.glb").string();
    EXPECT_EQ(refusal({"cast", missing, "--from", "0,0,0", "--to", "1,0,0"}), "abut: " + missing + ": no such file");
}

TEST_F(Cast, OfTheBundledLevel) {
    const std::string scene = ABUT_SCENE_FOLDER "/level.gltf";
    EXPECT_EQ(cast({scene, "--from", "0,1,5", "--to", "0,1,-8"}, 1)["hits"][0]["object"], "Level/Storehouse/Door");
    cast({scene, "--from", "0,1,5", "--to", "0,1,1"}, 0);
    const Json json = cast({scene, "--from", "0,1,5", "--to", "0.3,1.1,-8", "--bounces", "1000"}, 1);
    EXPECT_GT(json["hits"].size(), 5u);
}

}  // namespace
}  // namespace abut
