// The tool as a command line: arguments in; stdout, stderr and an exit code out.

#include "tool_runs.hpp"

#include <algorithm>
#include <limits>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class Tool : public test::ToolRuns {};

/// Boxes with edges of length 1 along x.
std::string boxes_at(const std::vector<float>& xs) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    for (std::size_t i = 0; i < xs.size(); ++i) builder.add_node("Box " + std::to_string(i), mesh, {xs[i], 0, 0});
    return builder.text();
}

TEST_F(Tool, HelpAndVersion) {
    for (const char* option : {"--help", "--version"}) {
        const Ran ran = run({option});
        EXPECT_EQ(ran.code, 0);
        EXPECT_EQ(ran.err, "");
        EXPECT_NE(ran.out.find("abut"), std::string::npos);
    }
    const Ran check = run({"check", "--help"});
    EXPECT_EQ(check.code, 0);
    for (const char* option : {"--clearance", "--allow", "--baseline", "--frames", "--pairs", "--json", "--spawn",
                               "--character", "--up", "--gap", "--closed"})
        EXPECT_NE(check.out.find(option), std::string::npos) << option;
}

TEST_F(Tool, ExitsWith0WhenAllIsFine) {
    const std::string file = write("fine.gltf", boxes_at({0, 1, 5})).string();
    const Ran ran = run({"check", file});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(ran.out.find("CLEAN"), std::string::npos) << ran.out;
}

TEST_F(Tool, ExitsWith1WhenSomethingIsFound) {
    const std::string file = write("faulty.gltf", boxes_at({0, 0.75f, 5})).string();
    const Ran ran = run({"check", file});
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.err, "");
    EXPECT_NE(ran.out.find("Box 0  and  Box 1"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("0.25 deep"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("3 taken as convex solids, 0 as meshes"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("1 tested of 3 possible"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("FAULTS FOUND: 1 pair collides"), std::string::npos) << ran.out;
}

TEST_F(Tool, JsonSaysTheSameUnrounded) {
    const std::string file = write("faulty.gltf", boxes_at({0, 0.9f, 5})).string();
    const Json json = checked({file}, 1);
    EXPECT_EQ(json["objects"], 3);
    EXPECT_EQ(json["frames"], 1);
    EXPECT_EQ(json["pairs"], 1);
    for (const char* stage : {"read", "build", "check"}) EXPECT_TRUE(json["seconds"][stage].is_number()) << stage;
    ASSERT_EQ(json["contacts"].size(), 1u);
    const Json& contact = json["contacts"][0];
    EXPECT_EQ(contact["a"], "Box 0");
    EXPECT_EQ(contact["b"], "Box 1");
    EXPECT_EQ(contact["frame"], 0);
    EXPECT_EQ(contact["last_frame"], 0);
    EXPECT_EQ(contact["normal"], Json({1.0, 0.0, 0.0}));
    const auto distance = contact["distance"].get<double>();
    EXPECT_NEAR(distance, -0.1, 1e-6);
    EXPECT_EQ(static_cast<double>(static_cast<float>(distance)), distance) << "a float, with all its digits";
    ASSERT_EQ(contact["points"].size(), 4u);
    for (const Json& point : contact["points"]) EXPECT_EQ(point.size(), 3u);
}

TEST_F(Tool, BadFilesAreRefused) {
    const std::string missing = (folder() / "missing.glb").string();
    EXPECT_EQ(refusal({"check", missing}), "abut: " + missing + ": no such file");
    EXPECT_EQ(refusal({"check", folder().string()}),
              "abut: " + folder().string() + ": the folder has no scene and no level in it or below it");
    EXPECT_EQ(refusal_of("empty.glb", ""), "is empty");
    EXPECT_EQ(refusal_of("picture.png", "\x89PNG\r\n\x1a\n"), "'.png' is not a known scene format");

    GltfBuilder whole;
    whole.add_node("Crate", whole.add_mesh("Box", box_triangles({1, 1, 1})));
    const std::string glb = whole.glb();
    EXPECT_EQ(refusal_of("cut.glb", std::string_view(glb).substr(0, glb.size() / 2)),
              "glTF container is truncated: " + std::to_string(glb.size() / 2) + " of " + std::to_string(glb.size()) +
                  " bytes");

    const auto box_with = [](auto&& change) {
        GltfBuilder builder;
        test::Triangles box = box_triangles({1, 1, 1});
        change(box);
        builder.add_node("Crate", builder.add_mesh("Box", box));
        return builder.glb();
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refusal_of("nan.glb", box_with([&](test::Triangles& box) { box.points[3].z = nan; })),
              "mesh 'Box', vertex 3: coordinate is not finite");
    EXPECT_EQ(refusal_of("index.glb", box_with([](test::Triangles& box) { box.triangles[2].y = 1000000; })),
              "mesh 'Box', triangle 2: index 1000000 is out of range (8 vertices)");
    const std::string flat = box_with([](test::Triangles& box) { box.triangles[5] = {1, 1, 2}; });
    const std::string flat_file = write("flat.glb", flat).string();
    EXPECT_EQ(
        refusal({"check", flat_file, "--strict"}),
        "abut: " + flat_file + ": mesh 'Box', triangle 5: zero area (without --strict such triangles are left out)");
    EXPECT_EQ(run({"check", flat_file, "--skip-degenerate"}).code, 0) << "as scripts of earlier versions have it";

    EXPECT_EQ(refusal_of("none.gltf", R"({"asset":{"version":"2.0"},"scenes":[{}],"scene":0})"),
              "no triangles in it: 0 objects");

    GltfBuilder circle;
    circle.add_node("A", ",\"children\":[1]");
    circle.add_node("B", ",\"children\":[0]");
    EXPECT_EQ(refusal_of("circle.gltf", circle.text()), "node tree: node 'A' is part of a cycle");

    GltfBuilder deep;
    const int mesh = deep.add_mesh("Box", box_triangles({1, 1, 1}));
    for (int i = 0; i < 9999; ++i)
        deep.add_node("n" + std::to_string(i), ",\"children\":[" + std::to_string(i + 1) + "]");
    deep.add_node("last", mesh);
    EXPECT_EQ(refusal_of("deep.gltf", deep.text()),
              "node tree is 10000 deep; the limit is 1000, passed at node 'n1000'");
}

TEST_F(Tool, BadUsageIsRefused) {
    const std::string file = write("fine.gltf", boxes_at({0, 1})).string();
    refusal({});
    refusal({"check"});
    EXPECT_EQ(refusal({"chekc", file}), "abut: 'chekc' is not a verb; did you mean 'check'?");
    refusal({"check", file, "--unknown"});
    EXPECT_EQ(refusal({"check", file, "--frames", "0"}), "abut: --frames: '0' is not a whole number from 1 to 1000000");
    EXPECT_EQ(refusal({"check", file, "--allow", "-1"}), "abut: --allow: '-1' is not a number of at least 0");
    EXPECT_EQ(refusal({"check", file, "--allow", "nan"}), "abut: --allow: 'nan' is not a number of at least 0");
    EXPECT_EQ(refusal({"check", file, "--clearance", ""}), "abut: --clearance: '' is not a number of at least 0");
    refusal({"check", file, "--pairs", "Box"});
    EXPECT_EQ(refusal({"check", file, "--pairs", "Box*:Wal*"}),
              "abut: " + file + ": --pairs: no object is named 'Wal*'");
    refusal({"check", file, "--baseline", (folder() / "none.json").string()});
}

TEST_F(Tool, PairsMayBeGivenSeveralTimes) {
    const std::string file = write("heap.gltf", boxes_at({0, 0.1f, 0.2f, 0.3f})).string();
    EXPECT_EQ(checked({file}, 1)["contacts"].size(), 6u);
    EXPECT_EQ(checked({file, "--pairs", "Box 0:Box 1"}, 1)["contacts"].size(), 1u);
    EXPECT_EQ(checked({file, "--pairs", "Box 0:Box 1", "--pairs", "Box 3:Box ?"}, 1)["contacts"].size(), 4u);
    EXPECT_EQ(checked({"--pairs", "Box 0:Box 1", file}, 1)["contacts"].size(), 1u);
}

TEST_F(Tool, AllowAndClearance) {
    const std::string file = write("row.gltf", boxes_at({0, 0.75f, 2})).string();
    EXPECT_EQ(checked({file, "--allow", "0.3"}, 0)["contacts"].size(), 0u);
    EXPECT_EQ(checked({file, "--allow", "0.3", "--clearance", "0.5"}, 1)["contacts"].size(), 1u);
    const Ran ran = run({"check", file, "--clearance", "0.5"});
    EXPECT_NE(ran.out.find("FAULTS FOUND: 1 pair collides, 1 pair comes too near"), std::string::npos) << ran.out;
}

TEST_F(Tool, BaselineLeavesWhatIsNew) {
    const auto baseline = [&](const std::string& content) { return write("old.json", content).string(); };
    const std::string old = run({"check", "--json", write("old.gltf", boxes_at({0, 0.75f, 5})).string()}).out;

    const std::string same = write("same.gltf", boxes_at({0, 0.75f, 5})).string();
    Json json = checked({same, "--baseline", baseline(old)}, 0);
    EXPECT_EQ(json["contacts"].size(), 0u);
    EXPECT_EQ(json["known"], 1);

    const std::string shallower = write("shallower.gltf", boxes_at({0, 0.8f, 5})).string();
    checked({shallower, "--baseline", baseline(old)}, 0);

    const std::string deeper = write("deeper.gltf", boxes_at({0, 0.7f, 5})).string();
    json = checked({deeper, "--baseline", baseline(old)}, 1);
    ASSERT_EQ(json["contacts"].size(), 1u);
    checked({deeper, "--baseline", baseline(old), "--allow", "0.06"}, 0);

    const std::string another = write("another.gltf", boxes_at({0, 0.75f, 1.5f})).string();
    json = checked({another, "--baseline", baseline(old)}, 1);
    ASSERT_EQ(json["contacts"].size(), 1u);
    EXPECT_EQ(json["contacts"][0]["a"], "Box 1");
    const Ran ran = run({"check", another, "--baseline", baseline(old)});
    EXPECT_NE(ran.out.find("FAULTS FOUND: 1 pair collides that didn't before"), std::string::npos) << ran.out;

    EXPECT_EQ(refusal({"check", same, "--baseline", baseline("{}")}),
              "abut: " + baseline("{}") + ": is no report of `abut check --json`");
    refusal({"check", same, "--baseline", baseline("")});
    refusal({"check", same, "--baseline", baseline(R"({"contacts":[{"a":1}]})")});
}

TEST_F(Tool, BaselineKnowsMoments) {
    const auto sliding = [](const std::vector<Vec3>& places) {
        GltfBuilder builder;
        const int mesh = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
        builder.add_node("Wall", mesh);
        builder.add_node("Walker", mesh);
        builder.add_motion(1, "Walk", {0, 1, 2, 3}, places);
        return builder.text();
    };
    const std::string early = write("early.gltf", sliding({{0.5f, 0, 0}, {9, 0, 0}, {9, 0, 0}, {9, 0, 0}})).string();
    const std::string late = write("late.gltf", sliding({{9, 0, 0}, {9, 0, 0}, {9, 0, 0}, {0.5f, 0, 0}})).string();
    const std::string old = write("old.json", run({"check", "--json", early}).out).string();
    checked({early, "--baseline", old}, 0);
    const Json json = checked({late, "--baseline", old}, 1);
    ASSERT_EQ(json["contacts"].size(), 1u);
    EXPECT_EQ(json["contacts"][0]["frame"], 3);
    EXPECT_EQ(json["contacts"][0]["time"], 3.0);
}

// A wall between two keys, with a walker through it in between: `check` once reported CLEAN.
TEST_F(Tool, ContactsBetweenFramesAreFound) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    builder.add_node("Wall", mesh);
    builder.add_node("Walker", mesh);
    builder.add_motion(1, "Walk", {0, 1}, {{-5, 0, 0}, {5, 0, 0}});
    const std::string file = write("walk.gltf", builder.text()).string();
    Json json = checked({file}, 1);
    EXPECT_EQ(json["frames"], 2);
    EXPECT_EQ(json["warnings"].size(), 1u) << "says that there is much between the keys";
    EXPECT_EQ(json["swept_pairs"], 1);
    ASSERT_EQ(json["contacts"].size(), 1u);
    const Json between = json["contacts"][0];
    EXPECT_EQ(between["frame"], 0);
    EXPECT_EQ(between["last_frame"], 0);
    EXPECT_EQ(between["between"], true);
    EXPECT_NEAR(between["fraction"].get<double>(), 0.4, 1e-6);
    EXPECT_NEAR(between["time"].get<double>(), 0.4, 1e-6);
    EXPECT_LT(between["distance"].get<double>(), -0.5);
    EXPECT_GE(between["last_time"].get<double>(), between["deepest_time"].get<double>());
    const Ran ran = run({"check", file});
    EXPECT_NE(ran.out.find("between frames 0 and 1: they touch at 0.4 s (fraction 0.4)"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("FAULTS FOUND: 1 pair collides"), std::string::npos) << ran.out;
    const std::string old = write("old.json", json.dump()).string();
    EXPECT_EQ(checked({file, "--baseline", old}, 0)["known"], 1);
    EXPECT_EQ(checked({file, "--allow", "1.1"}, 0)["contacts"].size(), 0u);

    json = checked({file, "--frames", "31"}, 1);
    EXPECT_EQ(json["frames"], 31);
    ASSERT_EQ(json["contacts"].size(), 1u);
    EXPECT_EQ(json["contacts"][0]["deepest_frame"], 15);
    EXPECT_EQ(json["contacts"][0]["deepest_time"], 0.5);
    EXPECT_FALSE(json["contacts"][0].contains("between"));
}

// For an animation of 1e9 seconds it once advised --frames 30000000001, which it refused.
TEST_F(Tool, TheFramesThatItAdvisesAreTaken) {
    for (const float length : {2.0f, 300.0f, 1e9f}) {
        GltfBuilder builder;
        builder.add_node("Walker", builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f})));
        builder.add_motion(0, "Walk", {0, length}, {{-5, 0, 0}, {5, 0, 0}});
        const std::string file = write("walk.gltf", builder.text()).string();
        const std::string text = run({"check", file}).out;
        const std::size_t at = text.find("--frames ");
        ASSERT_NE(at, std::string::npos) << text;
        const std::string frames = text.substr(at + 9, text.find(' ', at + 9) - at - 9);
        const Ran ran = run({"check", file, "--frames", frames});
        EXPECT_EQ(ran.code, 0) << ran.err;
        EXPECT_NE(ran.out.find("frames    " + frames + ", from 0 s to"), std::string::npos) << ran.out;
    }
}

// One triangle of zero area made check, cast and info refuse the whole file.
TEST_F(Tool, TrianglesOfZeroAreaAreLeftOutAndCounted) {
    GltfBuilder builder;
    test::Triangles box = box_triangles({0.5f, 0.5f, 0.5f});
    builder.add_node("Whole", builder.add_mesh("Whole", box), {0.75f, 0, 0});
    box.triangles.emplace_back(1, 1, 2);  // a corner twice
    box.points.insert(box.points.end(), {{0, 0, 0.5f}, {0.25f, 0, 0.5f}, {0.5f, 0, 0.5f}});
    box.triangles.emplace_back(8, 9, 10);  // three in a row
    const int mesh = builder.add_mesh("Box", box);
    builder.add_node("Crate", mesh);
    builder.add_node("Crate", mesh, {9, 0, 0});
    test::Triangles line;
    line.points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    line.triangles = {{0, 1, 2}};
    builder.add_node("Line", builder.add_mesh("Line", line));
    const std::string file = write("some.gltf", builder.text()).string();

    const Json left_out = {{"triangles", 5},
                           {"objects",
                            {{{"name", "Crate"}, {"triangles", 2}, {"shape", true}},
                             {{"name", "Crate#2"}, {"triangles", 2}, {"shape", true}},
                             {{"name", "Line"}, {"triangles", 1}, {"shape", false}}}}};
    const std::string line_of_text =
        "5 triangles of zero area: 2 of 'Crate', 2 of 'Crate#2', 1 of 'Line', which has no others and so no shape\n";
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"check", file},
                                                 {"info", file},
                                                 {"cast", file, "--from", "-5,0,0", "--to", "5,0,0"}}) {
        const int code = verb[0] == "info" ? 0 : 1;
        const Json json = json_of(verb, code);
        EXPECT_EQ(json["left_out"], left_out) << verb[0];
        EXPECT_EQ(json["objects"].is_array() ? json["objects"].size() : json["objects"].get<std::size_t>(), 3u);
        EXPECT_NE(run(verb).out.find(line_of_text), std::string::npos) << run(verb).out;
        std::vector<std::string> strict = verb;
        strict.push_back("--strict");
        EXPECT_EQ(refusal(strict), "abut: " + file +
                                       ": mesh 'Box', triangle 12: zero area (without --strict such triangles are left "
                                       "out)");
    }
    // Without them the crate is a convex solid, and found as before.
    const Json json = checked({file}, 1);
    EXPECT_EQ(json["solids"], 3);
    ASSERT_EQ(json["contacts"].size(), 1u);
    EXPECT_EQ(json["contacts"][0]["a"], "Crate");
    EXPECT_NEAR(json["contacts"][0]["distance"].get<double>(), -0.25, 1e-6);

    // Verbs that repair meshes take the file.
    EXPECT_EQ(run({"hull", file, "-o", out("hull.obj")}).code, 0);
    EXPECT_EQ(run({"decompose", file, "-o", out("parts.obj")}).code, 0);
    EXPECT_NE(run({"field", file, "-o", out("a.field"), "--cell", "0.1"}).code, 2);
    EXPECT_EQ(run({"walk", file}).code, 0);

    GltfBuilder nothing;
    nothing.add_node("Line", nothing.add_mesh("Line", line));
    EXPECT_EQ(refusal_of("line.gltf", nothing.text()), "all triangles in it have zero area: 0 objects");
}

// Repeated triangles are a finding, and no reason to refuse the file.
TEST_F(Tool, TrianglesThatAreThereTwiceAreTakenByAllVerbs) {
    GltfBuilder builder;
    test::Triangles box = box_triangles({0.5f, 0.5f, 0.5f});
    box.triangles.push_back(box.triangles[3]);
    builder.add_node("Crate", builder.add_mesh("Box", box));
    const std::string file = write("twice.gltf", builder.text()).string();
    const Json json = checked({file}, 0);
    ASSERT_EQ(json["duplicates"].size(), 1u);
    EXPECT_EQ(json["duplicates"][0]["pieces"], 1);
    EXPECT_EQ(json["duplicates"][0]["severity"], "warning");
    EXPECT_EQ(run({"cast", file, "--from", "-5,0.1,0", "--to", "5,0.1,0"}).code, 1);
    for (const char* verb : {"hull", "decompose"}) EXPECT_EQ(run({verb, file, "-o", out("o.obj")}).code, 0) << verb;
    EXPECT_NE(run({"field", file, "-o", out("a.field"), "--cell", "0.1"}).code, 2);
    for (const char* verb : {"info", "walk"}) EXPECT_EQ(run({verb, file}).code, 0) << verb;
}

/// A crate to start in, a passage of 0.5, a duplicate crate and an open one.
std::string faulty_level() {
    GltfBuilder builder;
    const int box = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    test::Triangles open = box_triangles({0.5f, 0.5f, 0.5f});
    open.triangles.pop_back();
    builder.add_node("A", box, {0, 0.5f, 0});
    builder.add_node("B", box, {1.5f, 0.5f, 0});
    builder.add_node("B copy", box, {1.5f, 0.5f, 0});
    builder.add_node("Open", builder.add_mesh("Open", open), {9, 0.5f, 0});
    builder.add_node("Spawn", ",\"translation\":[0.25,0.25,0]");
    return builder.text();
}

TEST_F(Tool, TellsSpawnsGapsDuplicatesAndLeaks) {
    const std::string file = write("level.gltf", faulty_level()).string();
    const Json json = checked({file, "--gap", "0.7", "--closed", "Open"}, 1);
    EXPECT_EQ(json["spawn_points"], 1);
    ASSERT_EQ(json["spawns"].size(), 1u);
    EXPECT_EQ(json["spawns"][0]["name"], "Spawn");
    EXPECT_EQ(json["spawns"][0]["fault"], "inside");
    EXPECT_EQ(json["spawns"][0]["object"], "A");
    EXPECT_NEAR(json["spawns"][0]["depth"].get<double>(), 0.25, 1e-6);
    EXPECT_EQ(json["spawns"][0]["free"].size(), 3u);
    ASSERT_GE(json["gaps"].size(), 1u);
    EXPECT_EQ(json["gaps"][0]["a"], "A");
    EXPECT_NEAR(json["gaps"][0]["width"].get<double>(), 0.5, 1e-6);
    EXPECT_EQ(json["gaps"][0]["points"].size(), 2u);
    ASSERT_EQ(json["duplicates"].size(), 1u);
    EXPECT_EQ(json["duplicates"][0]["objects"], Json({"B", "B copy"}));
    ASSERT_EQ(json["leaks"].size(), 1u);
    EXPECT_EQ(json["leaks"][0]["object"], "Open");
    EXPECT_EQ(json["leaks"][0]["kind"], "hole");
    EXPECT_EQ(json["leaks"][0]["edges"], 3);
    EXPECT_EQ(json["contacts"].size(), 1u) << "what is there twice touches, as it always did";

    const Ran text = run({"check", file, "--gap", "0.7", "--closed", "O*"});
    for (const char* part : {"spawns (ABUT301)\n", "gaps (ABUT401)\n", "duplicates (ABUT501)\n", "leaks (ABUT601)\n",
                             "again as B copy", "is 0.25 deep in A; free at", "0.5 wide at", "a hole of 3 edges",
                             "FAULTS FOUND: 1 spawn is blocked or out of place, 1 pair collides, "})
        EXPECT_NE(text.out.find(part), std::string::npos) << part << " in\n" << text.out;

    // A character of that width has the same passages.
    EXPECT_EQ(checked({file, "--character", "0.35,1"}, 1)["gaps"], json["gaps"]);
    EXPECT_EQ(checked({file}, 1)["gaps"].size(), 0u);
}

TEST_F(Tool, LevelFaultsAloneAreFoundToo) {
    const std::string file = write("open.gltf",
                                   [] {
                                       GltfBuilder builder;
                                       test::Triangles open = box_triangles({1, 1, 1});
                                       open.triangles.pop_back();
                                       builder.add_node("Open", builder.add_mesh("Open", open));
                                       return builder.text();
                                   }())
                                 .string();
    const Json json = checked({file, "--closed", "Open"}, 1);
    EXPECT_EQ(json["leaks"].size(), 1u);
    EXPECT_EQ(json["contacts"].size(), 0u);
    // Findings of the baseline aren't reported again.
    const std::string old = write("old.json", json.dump()).string();
    EXPECT_EQ(checked({file, "--closed", "Open", "--baseline", old}, 0)["known"], 1);
}

TEST_F(Tool, WithPairsItReportsNothingElse) {
    const std::string file = write("level.gltf", faulty_level()).string();
    const Json json = checked({file, "--gap", "0.7", "--pairs", "A:B"}, 1);
    EXPECT_EQ(json["gaps"].size(), 1u);
    for (const char* kind : {"contacts", "spawns", "duplicates", "leaks"}) EXPECT_EQ(json[kind].size(), 0u) << kind;
    const Json found = checked({file, "--pairs", "A:Open", "--closed", "Open", "--spawn", "Sp*"}, 1);
    EXPECT_EQ(found["leaks"].size(), 1u);
    EXPECT_EQ(found["spawns"].size(), 1u);
}

TEST_F(Tool, BadUsageOfLevelChecksIsRefused) {
    const std::string file = write("level.gltf", faulty_level()).string();
    EXPECT_EQ(refusal({"check", file, "--spawn", "Nobody"}), "abut: " + file + ": --spawn: nothing is named 'Nobody'");
    EXPECT_EQ(refusal({"check", file, "--closed", "Spawn"}),
              "abut: " + file + ": --closed: no object is named 'Spawn'");
    EXPECT_EQ(refusal({"check", file, "--character", "1"}),
              "abut: --character: '1' is not a radius above 0 and a height of at least twice as much: RADIUS,HEIGHT");
    EXPECT_EQ(refusal({"check", file, "--gap", "0"}),
              "abut: --gap: '0' is not a width above 0, or two of which the second is greater: LEAST,WIDTH");
    EXPECT_EQ(refusal({"check", file, "--up", "w"}), "abut: --up: 'w' is not one of x, -x, y, -y, z, -z and none");
}

TEST_F(Tool, InfoListsObjects) {
    GltfBuilder builder;
    builder.add_node("Crate", builder.add_mesh("Box", box_triangles({1, 2, 3})));
    test::Triangles sheet = box_triangles({1, 1, 1});
    sheet.triangles.resize(2);
    builder.add_node("Sheet", builder.add_mesh("Sheet", sheet));
    const std::string file = write("two.gltf", builder.text()).string();
    const Ran text = run({"info", file});
    EXPECT_EQ(text.code, 0);
    EXPECT_NE(text.out.find("2: 1 convex solids, 1 meshes"), std::string::npos) << text.out;
    const Json json = Json::parse(run({"info", "--json", file}).out);
    ASSERT_EQ(json["objects"].size(), 2u);
    EXPECT_EQ(json["objects"][0]["name"], "Crate");
    EXPECT_EQ(json["objects"][0]["kind"], "solid");
    EXPECT_EQ(json["objects"][0]["triangles"], 12);
    EXPECT_EQ(json["objects"][0]["max"], Json({1.0, 2.0, 3.0}));
    EXPECT_EQ(json["objects"][1]["kind"], "mesh");
    refusal({"info", (folder() / "missing.glb").string()});
}

// The tool finds exactly the faults that the script put into the level.
TEST_F(Tool, FindsTheFaultsOfTheBundledLevel) {
    const std::string scene = (folder() / "level.gltf").string();
    const std::string faults_file = (folder() / "faults.json").string();
    const std::string script = ABUT_SOURCE_FOLDER "/scenes/make_level.py";
    ASSERT_EQ(std::system(("python3 -B '" + script + "' '" + scene + "' --faults '" + faults_file + "'").c_str()), 0);
    const Json faults = Json::parse(content(faults_file));
    const Json json = checked({scene}, 1);
    EXPECT_GE(json["objects"], 40);
    EXPECT_LT(json["pairs"].get<double>(), 0.01 * json["possible_pairs"].get<double>());
    ASSERT_EQ(json["contacts"].size(), faults.size());
    ASSERT_GT(faults.size(), 10u);
    for (const Json& fault : faults) {
        const auto found = std::find_if(json["contacts"].begin(), json["contacts"].end(), [&](const Json& contact) {
            return (contact["a"] == fault["a"] && contact["b"] == fault["b"]) ||
                   (contact["a"] == fault["b"] && contact["b"] == fault["a"]);
        });
        ASSERT_NE(found, json["contacts"].end()) << fault;
        EXPECT_NEAR((*found)["time"].get<double>(), fault["from"].get<double>(), 1e-6) << fault;
        EXPECT_NEAR((*found)["last_time"].get<double>(), fault["to"].get<double>(), 1e-6) << fault;
        EXPECT_NEAR((*found)["distance"].get<double>(), -fault["depth"].get<double>(), 0.005) << fault;
    }
    ASSERT_EQ(json["spawns"].size(), 1u);
    EXPECT_EQ(json["spawns"][0]["name"], "Level/Player_Starts/Player_Start_2");
    EXPECT_EQ(json["spawns"][0]["object"], "Level/Yard/Boulder");
    EXPECT_EQ(json["duplicates"].size(), 6u) << "a chair of six parts";
    ASSERT_EQ(json["leaks"].size(), 1u);
    EXPECT_EQ(json["leaks"][0]["object"], "Level/Yard/Tank");
    EXPECT_EQ(json["leaks"][0]["edges"], 4);
}

}  // namespace
}  // namespace abut
