// `abut bake`: content-addressed results.

#include "tool/bake/inputs.hpp"
#include "tool/bake/sha256.hpp"
#include "tool/bake/verb_bake.hpp"
#include "tool_runs.hpp"

#include <algorithm>
#include <map>

namespace abut {
namespace {

namespace fs = std::filesystem;

using test::GltfBuilder;
using test::Json;
using test::Ran;

class Bake : public test::ToolRuns {
protected:
    /// A box with half edges of this length, in a file of this name.
    std::string box(const std::string& name, float half) const {
        GltfBuilder builder;
        builder.add_node("Box", builder.add_mesh("Box", test::box_triangles({half, half, half})));
        return write(name, builder.text()).string();
    }
    std::string list(const std::vector<std::string>& files) const {
        std::string text;
        for (const std::string& file : files) text += file + "\n";
        return write("list.txt", text).string();
    }
    Ran bake(const std::vector<std::string>& more, const std::string& verb = "hull") const {
        std::vector<std::string> all{"bake", out("list.txt"), "--verb", verb, "--cache", out("cache")};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }
    /// All files of the cache with their content.
    std::map<std::string, std::string> stored(const std::string& cache = "cache") const {
        std::map<std::string, std::string> result;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out(cache)))
            if (entry.is_regular_file()) result[fs::relative(entry, out(cache)).string()] = content(entry.path());
        return result;
    }
};

TEST(Sha256Test, KnownValues) {
    EXPECT_EQ(tool::sha256({}), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    const std::string abc = "abc";
    EXPECT_EQ(tool::sha256(std::as_bytes(std::span(abc))),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(BakeArguments, Shards) {
    for (const char* good : {"1/1", "2/3", "3/3"}) EXPECT_TRUE(tool::parse_shard(good)) << good;
    for (const char* bad : {"", "1", "0/3", "4/3", "1/0", "1/3x", "-1/3", "1/2/3"})
        EXPECT_FALSE(tool::parse_shard(bad)) << bad;
    for (const char* bad : {"", "0", "-1", "101", "nan", "5%"}) EXPECT_FALSE(tool::parse_percent(bad)) << bad;
}

TEST_F(Bake, ASecondRunMakesOnlyWhatIsMissing) {
    list({box("a.gltf", 1), box("b.gltf", 2)});
    const Ran first = bake({});
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(first.out, "hull 2 files: 2 made\n");
    const auto results = stored();
    EXPECT_EQ(results.size(), 4u) << "a report and a mesh of each";
    EXPECT_EQ(bake({}).out, "hull 2 files: 2 in the cache\n");
    fs::remove(out("cache/" + results.begin()->first));
    EXPECT_EQ(bake({}).out, "hull 2 files: 1 made, 1 in the cache\n");
    EXPECT_EQ(stored(), results);
}

TEST_F(Bake, AResultIsThatOfTheVerbAlone) {
    const std::string file = box("a.gltf", 1);
    list({file});
    ASSERT_EQ(bake({"--", "--max-vertices", "4"}).code, 0);
    ASSERT_EQ(run({"hull", file, "-o", out("a.glb"), "--max-vertices", "4"}).code, 0);
    bool is_there = false;
    for (const auto& [name, bytes] : stored())
        if (name.ends_with(".glb")) is_there = bytes == content(out("a.glb"));
    EXPECT_TRUE(is_there);
}

TEST_F(Bake, TheKeyHasAllThatCounts) {
    const std::string file = box("a.gltf", 1);
    list({file});
    bake({});
    const auto keys = [&] { return stored().size() / 2; };
    EXPECT_EQ(keys(), 1u);
    bake({"--", "--max-vertices", "8"});
    EXPECT_EQ(keys(), 2u) << "another option";
    bake({"--", "--max-vertices=8"});
    EXPECT_EQ(keys(), 2u) << "the same one, spelled otherwise";
    box("a.gltf", 1.5f);
    bake({});
    EXPECT_EQ(keys(), 3u) << "other bytes";
    box("a.gltf", 1);
    fs::create_directories(folder() / "elsewhere");
    fs::copy_file(file, folder() / "elsewhere/a.gltf");
    list({out("elsewhere/a.gltf")});
    bake({});
    EXPECT_EQ(keys(), 3u) << "another folder";
    list({box("b.gltf", 1)});
    bake({});
    EXPECT_EQ(keys(), 4u) << "another name, which the output has";
}

TEST_F(Bake, FilesThatAFileNamesAreItsInput) {
    write("two words.mtl", "newmtl m\n");
    write("tiles%20.tsx", "<tileset/>");
    write("unused.mtl", "newmtl u\n");
    const fs::path obj = write("a.obj", "mtllib two words.mtl\nv 0.5 1.25 2.0\n");
    const auto names = [](const Result<std::vector<tool::InputFile>>& files) {
        std::vector<std::string> result;
        for (const tool::InputFile& file : *files) result.push_back(file.name);
        return result;
    };
    EXPECT_EQ(names(tool::input_files(obj)), (std::vector<std::string>{"a.obj", "two words.mtl"}));
    // Through another file, in a folder, percent-encoded.
    fs::create_directories(folder() / "sub");
    write("sub/inner.bin", "bytes");
    write("sub/buffer one.json", R"({"uri": "inner.bin"})");
    const fs::path gltf = write("b.gltf", R"({"buffers": [{"uri": "sub/buffer%20one.json"}], "a.obj": 1.5})");
    EXPECT_EQ(names(tool::input_files(gltf)),
              (std::vector<std::string>{"b.gltf", "a.obj", "sub/buffer one.json", "sub/inner.bin", "two words.mtl"}));
    EXPECT_FALSE(tool::input_files(folder() / "missing.gltf"));
}

TEST_F(Bake, ShardsShareTheList) {
    std::vector<std::string> files;
    for (int i = 0; i < 7; ++i) files.push_back(box("box" + std::to_string(i) + ".gltf", 1.0f + static_cast<float>(i)));
    list(files);
    EXPECT_EQ(bake({"--shard", "1/3"}).out, "hull 3 files of 7 (shard 1 of 3): 3 made\n");
    EXPECT_EQ(bake({"--shard", "2/3"}).out, "hull 2 files of 7 (shard 2 of 3): 2 made\n");
    const Ran partly = bake({"--report"});
    EXPECT_EQ(partly.code, 2);
    EXPECT_NE(partly.out.find(files[2] + ": no result\n"), std::string::npos) << partly.out;
    EXPECT_NE(partly.out.find("hull 7 files: 5 in the cache, 2 without a result"), std::string::npos) << partly.out;
    EXPECT_EQ(bake({"--shard", "3/3"}).code, 0);
    EXPECT_EQ(bake({"--report"}).code, 0);
    const Json json = Json::parse(bake({"--report", "--json"}).out);
    ASSERT_EQ(json["items"].size(), 7u);
    EXPECT_EQ(json["items"][4]["file"], files[4]);
    EXPECT_TRUE(json["items"][4]["report"].is_object());
}

TEST_F(Bake, AnAuditFindsWrongBytes) {
    list({box("a.gltf", 1), box("b.gltf", 2)});
    bake({});
    EXPECT_EQ(bake({"--audit", "100"}).out, "hull 2 files: 2 made again, with equal bytes\n");
    for (const auto& [name, bytes] : stored()) {
        if (!name.ends_with(".json")) continue;
        Json entry = Json::parse(bytes);
        entry["report"]["tampered"] = true;
        write("cache/" + name, entry.dump() + "\n");
        break;
    }
    const Ran audited = bake({"--audit", "100"});
    EXPECT_EQ(audited.code, 1);
    EXPECT_NE(audited.out.find("1 made again, with equal bytes, 1 made again, with different bytes"), std::string::npos)
        << audited.out;
}

TEST_F(Bake, DamagedOutputsAreMadeAgain) {
    list({box("a.gltf", 1)});
    bake({});
    const auto good = stored();
    for (const auto& [name, bytes] : good)
        if (name.ends_with(".glb")) write("cache/" + name, bytes.substr(0, bytes.size() / 2));
    EXPECT_EQ(bake({}).out, "hull 1 file: 1 made\n");
    EXPECT_EQ(stored(), good);
}

TEST_F(Bake, ARejectedInputStopsNoOther) {
    const std::string bad = write("bad.obj", "o nothing\n").string();
    list({bad, box("a.gltf", 1), out("missing.gltf")});
    const Ran ran = bake({});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.out.find(bad + ": rejected: "), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find(out("missing.gltf") + ": rejected: no such file"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("hull 3 files: 1 made, 2 rejected\n"), std::string::npos) << ran.out;
    EXPECT_EQ(stored().size(), 2u) << "a rejection is not stored";
}

TEST_F(Bake, FindingsOfCheckAreResults) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", test::box_triangles({0.5f, 0.5f, 0.5f}));
    builder.add_node("A", mesh);
    builder.add_node("B", mesh, {0.75f, 0, 0});
    list({write("level.gltf", builder.text()).string()});
    EXPECT_EQ(bake({}, "check").code, 1);
    EXPECT_EQ(bake({}, "check").out, "check 1 file: 1 in the cache\n");
    // The options of the level's folder count.
    write("abut.toml", "allow = 1\n");
    EXPECT_EQ(bake({}, "check").out, "check 1 file: 1 made\n");
}

TEST_F(Bake, BadUsage) {
    const std::string file = list({box("a.gltf", 1)}), cache = out("cache");
    EXPECT_EQ(refusal({"bake", file, "--verb", "cast", "--cache", cache}),
              "abut: --verb: 'cast' is not one of check, hull, decompose, field and walk");
    EXPECT_EQ(refusal({"bake", file, "--verb", "hull", "--cache", cache, "--", "--max-vertexes", "9"}),
              "abut: hull: '--max-vertexes' is not an option of hull; did you mean '--max-vertices'?");
    EXPECT_EQ(refusal({"bake", file, "--verb", "decompose", "--cache", cache, "--", "--picture", "a.svg"}),
              "abut: decompose: --picture would write one file for all inputs");
    EXPECT_EQ(refusal({"bake", file, "--verb", "hull", "--cache", cache, "--shard", "3/2"}),
              "abut: --shard: '3/2' is not I/N with 1 <= I <= N, such as 2/8");
    EXPECT_EQ(refusal({"bake", out("none.txt"), "--verb", "hull", "--cache", cache}),
              "abut: " + out("none.txt") + ": no such file");
    EXPECT_EQ(refusal({"bake", write("empty.txt", "\n").string(), "--verb", "hull", "--cache", cache}),
              "abut: " + out("empty.txt") + ": the list names no file");
}

}  // namespace
}  // namespace abut
