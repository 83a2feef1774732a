// Help, suggestions, the man page and completions.

#include "tool/help/command_help.hpp"
#include "tool/help/suggestion.hpp"
#include "tool/help/wrap.hpp"
#include "tool_runs.hpp"

#include <algorithm>
#include <sstream>

namespace abut {
namespace {

using test::Json;
using test::Ran;

const std::vector<std::string> verbs{"check", "init", "cast", "hull", "fix",    "decompose",
                                     "field", "walk", "info", "bake", "replay", "help"};

class Help : public test::ToolRuns {};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(Wrap, BreaksAtBlanks) {
    EXPECT_EQ(tool::wrapped("one two three", 9, 2, 0), "one two\n  three\n");
    EXPECT_EQ(tool::wrapped("one incomprehensibilities", 9, 2, 0), "one\n  incomprehensibilities\n");
    EXPECT_EQ(tool::wrapped("", 9, 2, 0), "\n");
}

TEST(Suggestion, IsNear) {
    EXPECT_EQ(tool::nearest_word("chekc", verbs), "check");
    EXPECT_EQ(tool::nearest_word("decompse", verbs), "decompose");
    EXPECT_EQ(tool::nearest_word("feild", verbs), "field");
    EXPECT_EQ(tool::nearest_word("frobnicate", verbs), "");
    EXPECT_EQ(tool::nearest_word(std::string(100'000, 'x'), verbs), "");
}

TEST_F(Help, OfEveryVerb) {
    const std::string all = run({"help"}).out;
    EXPECT_EQ(run({"--help"}).out, all);
    for (const std::string& verb : verbs) {
        EXPECT_NE(all.find("\n  " + verb + " "), std::string::npos) << verb;
        const Ran ran = run({"help", verb});
        EXPECT_EQ(ran.code, 0) << verb;
        EXPECT_EQ(run({verb, "--help"}).out, ran.out) << verb;
        for (const char* part : {"\nUsage\n", "\nOptions\n", "\nExamples\n", "\nExit status\n  0"})
            EXPECT_NE(ran.out.find(part), std::string::npos) << verb << part;
        for (const std::string& line : lines_of(ran.out))
            EXPECT_TRUE(line.size() <= 80 || line.starts_with("  abut ") || line.starts_with("  find ")) << line;
        EXPECT_EQ(ran.out.find('\x1b'), std::string::npos) << "no colours where stdout is no terminal";
    }
}

TEST_F(Help, SuggestsWhatMayBeMeant) {
    EXPECT_EQ(refusal({"chekc", "a.glb"}), "abut: 'chekc' is not a verb; did you mean 'check'?");
    EXPECT_EQ(refusal({"frobnicate"}), "abut: 'frobnicate' is not a verb; `abut help` lists them");
    EXPECT_EQ(refusal({"help", "hul"}), "abut: 'hul' is not a verb; did you mean 'hull'?");
    EXPECT_EQ(refusal({"check", "a.glb", "--frmaes", "3"}),
              "abut: '--frmaes' is not an option of check; did you mean '--frames'?");
    EXPECT_EQ(refusal({"check", "a.glb", "--xyzzyx=1"}),
              "abut: '--xyzzyx' is not an option of check; `abut help check` lists them");
    EXPECT_EQ(refusal({"--verison"}), "abut: '--verison' is not an option of abut; did you mean '--version'?");
    EXPECT_EQ(refusal(std::vector<std::string>{}), "abut: a verb is needed; `abut help` lists them");
}

TEST_F(Help, Version) {
    const Json json = Json::parse(run({"--version", "--json"}).out);
    EXPECT_EQ(json["name"], "abut");
    EXPECT_EQ(run({"--version"}).out, "abut " + json["version"].get<std::string>() + "\n");
}

TEST_F(Help, QuietPrintsNothing) {
    test::GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", test::box_triangles({0.5f, 0.5f, 0.5f}));
    builder.add_node("A", mesh);
    builder.add_node("B", mesh, {0.75f, 0, 0});
    const std::string file = write("faulty.gltf", builder.text()).string();
    for (const char* option : {"-q", "--quiet"}) {
        const Ran ran = run({"check", file, option});
        EXPECT_EQ(ran.code, 1);
        EXPECT_EQ(ran.out + ran.err, "");
    }
    EXPECT_NE(refusal({"check", "missing.glb", "-q"}).find("no such file"), std::string::npos);
}

TEST_F(Help, ManPageAndCompletionsHaveEverything) {
    const std::string man = run({"help", "--man"}).out;
    EXPECT_TRUE(man.starts_with(".TH ABUT 1 "));
    for (const char* shell : {"bash", "zsh", "fish"}) {
        const std::string script = run({"help", "--completions", shell}).out;
        for (const std::string& verb : verbs) {
            EXPECT_NE(script.find(verb), std::string::npos) << shell << ' ' << verb;
            EXPECT_NE(man.find(".SH \"abut " + verb + "\""), std::string::npos) << verb;
        }
        EXPECT_NE(script.find("max-vertices"), std::string::npos) << shell;
        const std::string file = write(std::string("completion.") + shell, script).string();
        // The shell itself reads it, if it is there.
        const std::string check =
            std::string("! command -v ") + shell + " >/dev/null || " + shell + " -n '" + file + "' >/dev/null 2>&1";
        EXPECT_EQ(std::system(check.c_str()), 0) << shell;
    }
    EXPECT_NE(man.find("\\fB\\-\\-max\\-vertices\\fR \\fIN\\fR"), std::string::npos);
    EXPECT_EQ(refusal({"help", "--completions", "csh"}), "abut: --completions: 'csh' is not one of bash, zsh and fish");
}

}  // namespace
}  // namespace abut
