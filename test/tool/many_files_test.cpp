// Many files at once, and the formats that other programs read.

#include "tool_runs.hpp"

#include <algorithm>

#include <pugixml.hpp>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class ManyFiles : public test::ToolRuns {
protected:
    std::string level(const std::string& name, const std::vector<float>& xs) const {
        GltfBuilder builder;
        const int mesh = builder.add_mesh("Crate", box_triangles({0.5f, 0.5f, 0.5f}));
        for (std::size_t i = 0; i < xs.size(); ++i)
            builder.add_node("Crate <" + std::to_string(i) + ">", mesh, {xs[i], 0, 0});
        std::filesystem::create_directories((folder() / name).parent_path());
        return write(name, builder.text()).string();
    }
    /// Runs the validator with docs/check.schema.json, and returns what it objects to.
    std::string objections(const std::string& json) const {
        const std::string file = write("report.json", json).string(), out = (folder() / "objections").string();
        const std::string command = "python3 " ABUT_SOURCE_FOLDER "/test/tool/validate_json.py " ABUT_SOURCE_FOLDER
                                    "/docs/check.schema.json '" +
                                    file + "' >'" + out + "' 2>&1";
        const int status = std::system(command.c_str());
        return status == 0 ? "" : content(out) + "?";
    }
};

TEST_F(ManyFiles, FoldersListsAndFiles) {
    const std::string clean = level("levels/clean.gltf", {0, 5}), deep = level("levels/more/deep.gltf", {0, 0.5f});
    write("levels/readme.txt", "no level");
    const std::string levels = (folder() / "levels").string();
    for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{{levels}, {clean, deep}}) {
        std::vector<std::string> arguments = names;
        arguments.insert(arguments.begin(), "check");
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.code, 1) << ran.err;
        EXPECT_TRUE(ran.out.starts_with(clean + ": clean\n")) << ran.out;
        EXPECT_TRUE(ran.out.ends_with("2 files: 1 with errors, 0 with warnings, 1 clean\n")) << ran.out;
        const Json json = checked(names, 1);
        ASSERT_EQ(json["files"].size(), 2u);
        EXPECT_EQ(json["files"][0]["file"], clean);
        EXPECT_EQ(json["files"][1]["verdict"], "errors");
        EXPECT_EQ(objections(json.dump()), "");
    }
    EXPECT_EQ(run({"check", clean, level("levels/fine.gltf", {0})}).code, 0);
    std::filesystem::create_directories(folder() / "empty");
    const std::string empty = (folder() / "empty").string();
    EXPECT_EQ(refusal({"check", empty}), "abut: " + empty + ": the folder has no scene and no level in it or below it");
}

TEST_F(ManyFiles, AFileThatCantBeReadIsNamedAndTheOthersAreChecked) {
    const std::string deep = level("b/deep.gltf", {0, 0.5f}), bad = write("b/bad.gltf", "{").string();
    const Ran ran = run({"check", bad, deep});
    EXPECT_EQ(ran.code, 2);
    EXPECT_TRUE(ran.err.starts_with("abut: " + bad + ": ")) << ran.err;
    EXPECT_NE(ran.out.find("FAULTS FOUND: 1 pair collides\n"), std::string::npos) << ran.out;
    EXPECT_TRUE(ran.out.ends_with("2 files: 1 with errors, 0 with warnings, 0 clean, 1 unreadable\n")) << ran.out;
    const Json json = Json::parse(run({"check", "--json", bad, deep}).out);
    EXPECT_EQ(json["files"][0]["verdict"], "unreadable");
    EXPECT_EQ(objections(json.dump()), "");
}

TEST_F(ManyFiles, TheBaselineOfManyFiles) {
    const std::string a = level("c/a.gltf", {0, 0.5f}), b = level("c/b.gltf", {0, 0.6f});
    const std::string old = write("old.json", run({"check", "--json", a, b}).out).string();
    EXPECT_EQ(run({"check", a, b, "--baseline", old}).code, 0);
    EXPECT_EQ(checked({b, "--baseline", old}, 0)["known"], 1);
    EXPECT_EQ(run({"check", a, level("c/new.gltf", {0, 0.5f}), "--baseline", old}).code, 1);
}

// Every kind of finding, in 2D and 3D, conforms to the schema; and what doesn't is found.
TEST_F(ManyFiles, JsonConformsToItsSchema) {
    const std::string room = ABUT_SCENE_FOLDER "/level.gltf", plateau = ABUT_SOURCE_FOLDER "/scenes/plateau.tmj";
    Json json = Json::parse(
        run({"check", "--json", room, "--character", "0.3,1.8", "--closed", "*Tank*", "--severity", "floating=warning"})
            .out);
    EXPECT_EQ(objections(json.dump()), "");
    for (const char* array : {"contacts", "spawns", "gaps", "duplicates", "leaks"})
        EXPECT_FALSE(json[array].empty()) << array;
    EXPECT_EQ(objections(run({"check", "--json", plateau, "--clearance", "20"}).out), "");
    EXPECT_EQ(objections(run({"check", "--json", plateau, "--baseline",
                              write("old.json", run({"check", "--json", plateau}).out).string()})
                             .out),
              "");
    json["contacts"][0].erase("code");
    EXPECT_NE(objections(json.dump()), "");
}

TEST_F(ManyFiles, SarifHasARuleForEachResult) {
    const std::string deep = level("s/deep level.gltf", {0, 0.5f}), bad = write("s/bad.gltf", "{").string();
    const std::string sarif = out("findings.sarif");
    EXPECT_EQ(run({"check", deep, bad, "--sarif", sarif}).code, 2);
    const Json json = Json::parse(content(sarif));
    EXPECT_EQ(json["version"], "2.1.0");
    const Json& run = json["runs"][0];
    ASSERT_EQ(run["results"].size(), 1u);
    const Json& result = run["results"][0];
    EXPECT_EQ(result["ruleId"], "ABUT101");
    EXPECT_EQ(run["tool"]["driver"]["rules"][result["ruleIndex"].get<std::size_t>()]["id"], "ABUT101");
    EXPECT_EQ(result["level"], "error");
    const std::string text = result["message"]["text"];
    EXPECT_TRUE(text.starts_with("Crate <0> and Crate <1>: 0.5 deep, near ")) << text;
    const std::string uri = result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"];
    EXPECT_TRUE(uri.starts_with("file:///") && uri.ends_with("/s/deep%20level.gltf")) << uri;
    EXPECT_EQ(run["invocations"][0]["executionSuccessful"], false);
    EXPECT_EQ(refusal({"check", deep, "--sarif", out("none/findings.sarif")}).substr(0, 6), "abut: ");
}

TEST_F(ManyFiles, JunitHasASuiteForEachFile) {
    const std::string deep = level("j/deep.gltf", {0, 0.5f}), bad = write("j/bad.gltf", "{").string();
    const std::string junit = out("findings.xml");
    run({"check", deep, bad, "--junit", junit});
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file(junit.c_str()));
    const pugi::xml_node suite = document.child("testsuites").child("testsuite");
    EXPECT_EQ(suite.attribute("name").value(), deep);
    EXPECT_EQ(suite.attribute("tests").as_int(), 7);
    EXPECT_EQ(suite.attribute("failures").as_int(), 1);
    const pugi::xml_node contact = suite.find_child_by_attribute("testcase", "name", "contact");
    const std::string text = contact.child("failure").text().get();
    EXPECT_TRUE(text.starts_with("ABUT101 Crate <0> and Crate <1>: 0.5 deep")) << text;
    EXPECT_EQ(suite.next_sibling("testsuite").attribute("errors").as_int(), 1);
}

TEST_F(ManyFiles, GithubAnnotationsAreOneLineEach) {
    const std::string deep = level("g/50%, deep.gltf", {0, 0.5f});
    const Ran ran = run({"check", deep, "--github"});
    EXPECT_EQ(ran.code, 1);
    const std::string line = ran.out.substr(0, ran.out.find('\n'));
    EXPECT_NE(line.find("/g/50%25%2C deep.gltf,title=ABUT101 overlap::Crate <0> and Crate <1>: 0.5 deep"),
              std::string::npos)
        << line;
    EXPECT_TRUE(line.starts_with("::error file=")) << line;
    EXPECT_EQ(refusal({"check", deep, "--github", "--json"}),
              "abut: --github excludes --json; `abut help check` explains it");
}

}  // namespace
}  // namespace abut
