// The file abut.toml, and `abut init`, which writes one.

#include "tool_runs.hpp"

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class Config : public test::ToolRuns {
protected:
    /// Two crates, 0.25 deep in each other.
    std::string level(const std::string& name) const {
        GltfBuilder builder;
        const int mesh = builder.add_mesh("Crate", box_triangles({0.5f, 0.5f, 0.5f}));
        builder.add_node("A*b", mesh);
        builder.add_node("C:d", mesh, {0.75f, 0, 0});
        std::filesystem::create_directories((folder() / name).parent_path());
        return write(name, builder.text()).string();
    }
    std::string refusal_with(const std::string& toml) const {
        const std::string file = level("bad/level.gltf"), config = write("bad/abut.toml", toml).string();
        std::string line = refusal({"check", file});
        EXPECT_TRUE(line.starts_with("abut: " + config)) << line;
        return line.substr(std::min(line.size(), ("abut: " + config).size()));
    }
};

TEST_F(Config, OptionsAreReadBesideTheLevelAndAbove) {
    const std::string beside = level("a/level.gltf"), below = level("a/b/c/level.gltf");
    checked({beside}, 1);
    write("a/abut.toml", "allow = 0.3\n");
    for (const std::string& file : {beside, below}) {
        EXPECT_EQ(checked({file}, 0)["contacts"].size(), 0u);
        EXPECT_EQ(checked({file, "--no-config"}, 1)["contacts"].size(), 1u);
        EXPECT_EQ(checked({file, "--allow", "0.2"}, 1)["contacts"].size(), 1u) << "the command line counts";
    }
    write("a/b/abut.toml", "");
    checked({below}, 1);
    checked({below, "--config", (folder() / "a/abut.toml").string()}, 0);
    EXPECT_EQ(refusal({"check", below, "--config", "none.toml"}), "abut: none.toml: no such file");
}

TEST_F(Config, AllFormsOfValues) {
    const std::string file = level("all/level.gltf");
    write("all/abut.toml",
          "character = [0.3, 1.8]\n"
          "gap = 0.5\n"
          "up = \"z\"\n"
          "frames = 3\n"
          "warnings-as-errors = true\n"
          "ignore = [\"ABUT101 A*:C*\"]\n"
          "[severity]\n"
          "contact = \"warning\"\n"
          "\"ABUT6*\" = \"off\"\n");
    EXPECT_EQ(checked({file}, 0)["ignored"], 1);
    write("all/abut.toml", "[severity]\ncontact = \"warning\"\n");
    EXPECT_EQ(checked({file}, 0)["contacts"][0]["severity"], "warning");
    write("all/abut.toml", "allow = 0.3\n[level.\"l*.gltf\"]\nallow = 0.2\n[level.\"other.gltf\"]\nallow = 9\n");
    checked({file}, 1);
    write("all/abut.toml", "ignore = [\"nothing\"]\n[level.\"l*.gltf\"]\nignore = [\"A*\"]\n");
    const Json both = checked({file}, 0);
    EXPECT_EQ(both["ignored"], 1);
    EXPECT_EQ(both["warnings"][0], (folder() / "all/abut.toml").string() + ":1: ignore: 'nothing' matches no finding");
}

TEST_F(Config, ErrorsNameTheLineAndTheKey) {
    EXPECT_EQ(refusal_with("# two lines\nclearence = 1\n"), ":2: 'clearence' is no option of abut check");
    EXPECT_EQ(refusal_with("\nallow = true\n"),
              ":2: allow is true or false, not a number, a string or a list of numbers");
    EXPECT_EQ(refusal_with("allow = -1\n"), ":1: allow: '-1' is not a number of at least 0");
    EXPECT_EQ(refusal_with("strict = 1\n"), ":1: strict is a number, not true or false");
    EXPECT_EQ(refusal_with("ignore = \"A:B\"\n"), ":1: ignore is a string, not a list of strings");
    EXPECT_EQ(refusal_with("ignore = [1]\n"), ":1: an item of ignore is a number, not a string");
    EXPECT_EQ(
        refusal_with("\n[severity]\nleaks = \"off\"\n"),
        ":3: severity: 'leaks' is no kind and no code; the kinds are spawn, inside, contact, gap, duplicate, leak, "
        "floating");
    EXPECT_EQ(refusal_with("severity = 1\n"), ":1: severity is a number, not a table");
    EXPECT_EQ(refusal_with("[level.\"other.gltf\"]\ntypo = 1\n"), ":2: 'typo' is no option of abut check");
    EXPECT_TRUE(refusal_with("allow = \n").starts_with(":1: ")) << refusal_with("allow = \n");
}

TEST_F(Config, InitIgnoresWhatIsThere) {
    const std::string file = level("init/level.gltf"), config = (folder() / "init/abut.toml").string();
    checked({file}, 1);
    const Ran ran = run({"init", file, "--clearance", "0.1"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out, config + ": ignores 1 finding of " + file + "\n");
    EXPECT_EQ(checked({file}, 0)["ignored"], 1);
    EXPECT_EQ(refusal({"init", file}),
              "abut: " + config + ": there is a section for level.gltf already: remove it first");
    // Another level has a section of its own; what is there stays.
    const std::string other = level("init/other.gltf");
    checked({other}, 1);
    EXPECT_EQ(run({"init", other}).code, 0);
    EXPECT_EQ(checked({other}, 0)["ignored"], 1);
    EXPECT_EQ(checked({file}, 0)["ignored"], 1);
    EXPECT_TRUE(content(config).starts_with("# Options of `abut check`"));
}

}  // namespace
}  // namespace abut
