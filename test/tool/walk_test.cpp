// `abut walk` as a command line.

#include "tool_runs.hpp"
#include <abut/io/read_walk_mesh.hpp>
#include <abut/walk/file.hpp>
#include <abut/walk/survey.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace abut {
namespace {

using test::Json;
using test::Ran;

class WalkVerb : public test::ToolRuns {
protected:
    Json walked(std::vector<std::string> arguments, int code = 0) const {
        arguments.insert(arguments.begin(), "walk");
        return json_of(std::move(arguments), code);
    }
    /// An OBJ of unit squares at height y where the plan has a #, x to the right and z down, by the name.
    static std::string squares(const std::string& name, const std::vector<std::string>& plan, float y) {
        std::string text = "o " + name + "\n";
        for (std::size_t z = 0; z < plan.size(); ++z)
            for (std::size_t x = 0; x < plan[z].size(); ++x) {
                if (plan[z][x] != '#') continue;
                for (const auto& [i, k] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}})
                    text += "v " + std::to_string(static_cast<int>(x) + i) + " " + std::to_string(y) + " " +
                            std::to_string(static_cast<int>(z) + k) + "\n";
                text += "f -4 -3 -2 -1\n";
            }
        return text;
    }
    /// A room of 5 x 3 with a pillar, and a shelf above.
    std::string room() const {
        return write("room.obj", squares("room", {"#####", "##.##", "#####"}, 0) + squares("shelf", {"##"}, 2))
            .string();
    }
    static std::size_t count(const std::string& text, std::string_view what) {
        std::size_t result = 0;
        for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++result;
        return result;
    }
};

TEST_F(WalkVerb, TellsWhatThereIs) {
    const std::string file = room();
    const Json json = walked({file});
    EXPECT_EQ(json["triangles"], 32);
    EXPECT_EQ(json["objects"], (Json{"room", "shelf"}));
    EXPECT_EQ(json["report"]["islands"], 2);
    EXPECT_EQ(json["report"]["border"], 16 + 4 + 6);
    ASSERT_EQ(json["islands"].size(), 2u);
    EXPECT_EQ(json["islands"][0]["triangles"], 28);
    EXPECT_EQ(json["islands"][0]["area"], 14);
    EXPECT_EQ(json["islands"][1]["area"], 2);
    EXPECT_EQ(json["islands"][1]["min"], (Json{0, 2, 0}));
    EXPECT_EQ(json["islands"][1]["max"], (Json{2, 2, 1}));
    ASSERT_EQ(json["borders"].size(), 3u);
    EXPECT_EQ(json["borders"][0]["length"], 16);
    EXPECT_EQ(json["borders"][0]["rim"], true);
    EXPECT_EQ(json["borders"][1]["length"], 4);
    EXPECT_EQ(json["borders"][1]["rim"], false);
    EXPECT_EQ(json["borders"][1]["points"].size(), 4u);
    EXPECT_EQ(json["borders"][2]["island"], 1);
    EXPECT_TRUE(json["pinched"].empty());
    EXPECT_FALSE(json.contains("way"));
    for (const char* stage : {"read", "survey", "find", "write"})
        EXPECT_TRUE(json["seconds"][stage].is_number()) << stage;

    const Ran ran = run({"walk", file});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    for (const char* said : {"mesh        32 triangles of 2 objects: 2 components, 26 border edges\n",
                             "component 0 28 triangles, area 14, from (0, 0, 0) to (5, 0, 3)\n",
                             "rim 16 long, 1 hole: 4 round (2.5, 0, 1.5)\n", "rim 6 long\n"})
        EXPECT_NE(ran.out.find(said), std::string::npos) << said << "\n" << ran.out;
}

TEST_F(WalkVerb, FindsThePath) {
    const std::string file = room();
    const Json json = walked({file, "--from", "1.5,0.25,1.5", "--to", "3.5,-0.5,1.5"});
    EXPECT_EQ(json["from"]["asked"], (Json{1.5, 0.25, 1.5}));
    EXPECT_EQ(json["from"]["point"], (Json{1.5, 0, 1.5}));
    EXPECT_EQ(json["from"]["off"], 0.25);
    EXPECT_EQ(json["from"]["island"], 0);
    EXPECT_EQ(json["to"]["off"], 0.5);
    double weights = 0;
    for (const Json& weight : json["to"]["weights"]) weights += weight.get<double>();
    EXPECT_EQ(weights, 1);
    EXPECT_NEAR(json["way"]["length"].get<double>(), 1 + 2 * std::sqrt(0.5), 1e-6) << "round the pillar";
    ASSERT_EQ(json["way"]["points"].size(), 4u);
    EXPECT_EQ(json["way"]["points"][0], json["from"]["point"]);
    EXPECT_EQ(json["way"]["points"][3], json["to"]["point"]);

    const Ran ran = run({"walk", file, "--from", "1.5,0.25,1.5", "--to", "3.5,-0.5,1.5"});
    EXPECT_EQ(ran.code, 0);
    for (const char* said : {"from        (1.5, 0.25, 1.5): on triangle ",
                             " of component 0 at (1.5, 0, 1.5), 0.25 off\n", "   4. (3.5, 0, 1.5)\n"})
        EXPECT_NE(ran.out.find(said), std::string::npos) << said << "\n" << ran.out;
    EXPECT_TRUE(ran.out.ends_with("\nPATH: 2.414 long, from (1.5, 0, 1.5) to (3.5, 0, 1.5)\n")) << ran.out;
}

TEST_F(WalkVerb, TellsThatThereIsNone) {
    const std::string file = room();
    const Json json = walked({file, "--from", "0.5,0,0.5", "--to", "0.5,2,0.5"}, 1);
    EXPECT_EQ(json["way"], nullptr);
    EXPECT_EQ(json["to"]["island"], 1);
    const Ran ran = run({"walk", file, "--from", "0.5,0,0.5", "--to", "0.5,2,0.5"});
    EXPECT_EQ(ran.code, 1);
    EXPECT_TRUE(ran.out.ends_with("\nNO PATH: (0.5, 0, 0.5) is on component 0, (0.5, 2, 0.5) on component 1\n"))
        << ran.out;
}

TEST_F(WalkVerb, ReachesAsFarAsGiven) {
    const std::string file = room();
    const std::vector<std::string> ends{file, "--from", "0.5,0.25,0.5", "--to", "4.5,0,0.5", "--reach"};
    const auto within = [&](const char* reach, int code) {
        std::vector<std::string> arguments = ends;
        arguments.emplace_back(reach);
        return walked(arguments, code);
    };
    EXPECT_NEAR(within("0.25", 0)["way"]["length"].get<double>(), 4, 1e-9);
    EXPECT_EQ(within("0.24", 1)["way"], nullptr);
    const Ran ran = run({"walk", file, "--from", "0.5,0,0.5", "--to", "4.5,0,9.5", "--reach", "1"});
    EXPECT_EQ(ran.code, 1);
    EXPECT_TRUE(ran.out.ends_with("\nNO PATH: (4.5, 0, 9.5) is 6.5 off the mesh, farther than 1\n")) << ran.out;
}

TEST_F(WalkVerb, TakesWhatIsNamed) {
    const std::string file = room();
    EXPECT_EQ(walked({file, "--name", "sh?lf"})["triangles"], 4);
    EXPECT_EQ(walked({file, "--name", "room"})["objects"], Json{"room"});
    EXPECT_EQ(refusal({"walk", file, "--name", "roof"}),
              "abut: " + file + ": nothing in it is named 'roof'; there are 'room', 'shelf'");
}

TEST_F(WalkVerb, WritesWhatAGameLoads) {
    const std::string file = room(), baked = out("room.walk");
    const Json json = walked({file, "-o", baked, "--name", "room"});
    EXPECT_EQ(json["output"], baked);
    EXPECT_EQ(json["file_bytes"], std::filesystem::file_size(baked));
    const Result<WalkMesh> mesh = read_walk_mesh(baked);
    ASSERT_TRUE(mesh) << mesh.problem().message;
    EXPECT_EQ(save(*mesh), save(*read_walk_mesh(file, "room")));

    Json again = walked({baked, "--from", "1.5,0,1.5", "--to", "3.5,0,1.5"});
    EXPECT_NEAR(again["way"]["length"].get<double>(), 1 + 2 * std::sqrt(0.5), 1e-6);
    Json info = json_of({"info", baked}, 0);
    EXPECT_EQ(info["borders"], json["borders"]);
    EXPECT_EQ(info["report"], json["report"]);
    const Ran ran = run({"info", baked});
    EXPECT_NE(ran.out.find("mesh        28 triangles of a baked mesh: 1 component"), std::string::npos) << ran.out;

    std::string bytes = content(baked);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
    EXPECT_EQ(refusal({"walk", write("damaged.walk", bytes).string()}),
              "abut: " + out("damaged.walk") + ": the walk mesh is damaged: its checksum is wrong");
    EXPECT_EQ(refusal({"walk", baked, "--name", "room"}), "abut: " + baked + ": is baked, and has no names for --name");
}

TEST_F(WalkVerb, NamesWhatIsWrong) {
    const std::string touching = write("pinched.obj", squares("floor", {"####", "#.##", "##.#", "####"}, 0)).string();
    EXPECT_EQ(walked({touching})["pinched"], (Json{{2, 0, 2}}));
    EXPECT_NE(run({"walk", touching}).out.find("vertices    1 non-manifold vertex: (2, 0, 2)\n"), std::string::npos);
    const std::string wall =
        write("wall.obj", squares("floor", {"##"}, 0) + "v 1 0 0\nv 1 0 1\nv 1 1 1\nv 1 1 0\nf -4 -3 -2 -1\n").string();
    EXPECT_EQ(walked({wall})["crowded"].size(), 1u);
    EXPECT_NE(run({"walk", wall}).out.find("edges       1 non-manifold edge: (1, 0, 0.5)\n"), std::string::npos);
    std::string strip = "o strip\nv 0 0 0\nv 0 1 0\nv 4 0 0\nv 4 1 0\nv 2 0 3\nv 2 1 3\n";
    strip += "f 1 2 4\nf 1 4 3\nf 3 4 6\nf 3 6 5\nf 5 6 1\nf 5 1 2\n";
    const std::string moebius = write("moebius.obj", strip).string();
    EXPECT_EQ(walked({moebius})["mirrored"].size(), 1u);
    EXPECT_NE(run({"walk", moebius}).out.find("mirrored    1 edge of inconsistent orientation: ("), std::string::npos);
}

TEST_F(WalkVerb, DrawsTheMesh) {
    const std::string file = room(), picture = out("room.svg");
    const std::vector<std::string> arguments{"walk",   file,           "--picture", picture,
                                             "--from", "1.5,0.25,1.5", "--to",      "3.5,0,1.5"};
    EXPECT_EQ(run(arguments).code, 0);
    const std::string svg = content(picture);
    EXPECT_TRUE(svg.starts_with("<svg")) << svg.substr(0, 100);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    EXPECT_EQ(count(svg, "seen from +y"), 1u);
    EXPECT_EQ(count(svg, "seen from +z"), 1u);
    EXPECT_EQ(count(svg, "stroke-dasharray"), 4u) << "how far off the ends are, twice";
    EXPECT_EQ(run(arguments).code, 0);
    EXPECT_EQ(content(picture), svg) << "the same bytes";
    EXPECT_EQ(run({"walk", file, "--name", "room", "--picture", picture}).code, 0);
    EXPECT_EQ(count(content(picture), "seen from"), 1u) << "flat: nothing to be seen from the side";
}

TEST_F(WalkVerb, RefusesInOneLine) {
    const std::string file = room();
    const auto refused = [&](const std::vector<std::string>& more) { return refusal("walk", file, more); };
    EXPECT_EQ(refused({"--from", "1,2,3"}), "abut: --from needs --to");
    EXPECT_EQ(refused({"--to", "1,2,3"}), "abut: --to needs --from");
    EXPECT_EQ(refused({"--reach", "1"}), "abut: --reach needs --from and --to");
    for (const char* point : {"1,2", "a,b,c", "1,2,nan", "1,2,3,4", ""})
        EXPECT_EQ(refused({"--from", point, "--to", "0,0,0"}),
                  "abut: --from: '" + std::string(point) +
                      "' is not a point, three numbers with commas between them: "
                      "X,Y,Z");
    EXPECT_EQ(refused({"--from", "0,0,0", "--to", "1,0,0", "--reach", "-1"}),
              "abut: --reach: '-1' is not a number of at least 0");
    EXPECT_EQ(refused({"-o", "room.bin"}), "abut: room.bin: doesn't end in .walk");
    EXPECT_EQ(refused({"-o", out("none/r.walk")}),
              "abut: " + out("none/r.walk") + ": can't be written: No such file or directory");
    EXPECT_EQ(refused({"--picture", out("none/r.svg")}),
              "abut: " + out("none/r.svg") + ": can't be written: No such file or directory");
    EXPECT_EQ(refusal({"walk", out("none.obj")}), "abut: " + out("none.obj") + ": no such file");
    const std::string flat = write("flat.svg", "<svg/>").string();
    EXPECT_EQ(refusal({"walk", flat}), "abut: " + flat + ": is a 2D level, and has no meshes");
    const std::string line = write("line.obj", "o a\nv 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").string();
    EXPECT_EQ(refusal({"walk", line}), "abut: " + line + ": no triangle of the walk mesh has an area");
    const std::string baked = out("same.walk");
    EXPECT_EQ(run({"walk", file, "-o", baked}).code, 0);
    EXPECT_EQ(refusal({"walk", baked, "-o", baked}),
              "abut: " + baked + ": is the mesh itself, and would be overwritten");
    expect_bad_meshes_refused("walk", out("p.walk"));
}

}  // namespace
}  // namespace abut
