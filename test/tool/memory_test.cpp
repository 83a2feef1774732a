// The tool with too little memory.

#include "tool/shared/import_in_child.hpp"
#include "tool_runs.hpp"

#include <algorithm>

namespace abut {
namespace {

using test::GltfBuilder;
using test::Json;
using test::Ran;

class Memory : public test::ToolRuns {
protected:
    void SetUp() override {
        if (!tool::limits_memory()) GTEST_SKIP() << "not in builds with sanitizers";
    }

    /// Rods across each other: each of the first half overlaps each of the second, and no point is in three.
    std::string grid_of_rods(int count) const {
        GltfBuilder builder;
        const float half = 0.25f * static_cast<float>(count) + 1;
        const int along_x = builder.add_mesh("X", test::box_triangles({half, 0.2f, 0.2f}));
        const int along_y = builder.add_mesh("Y", test::box_triangles({0.2f, half, 0.2f}));
        for (int i = 0; i < count / 2; ++i) {
            const float at = static_cast<float>(i) - half + 1;
            builder.add_node("X " + std::to_string(i), along_x, {0, at, 0});
            builder.add_node("Y " + std::to_string(i), along_y, {at, 0, 0});
        }
        return write("grid.gltf", builder.text()).string();
    }

    static void expect_one_line(const Ran& ran, const std::string& line) {
        EXPECT_EQ(ran.code, 2);
        EXPECT_EQ(ran.out, "");
        EXPECT_EQ(ran.err, "abut: " + line + "\n");
    }
};

// 719,400 pairs took 2,126 MB, and more many times as much.
TEST_F(Memory, ContactsBeyondTheLimitAreCountedAlone) {
    const std::string file = grid_of_rods(1200);
    const Ran ran = run_within(1000, {"check", file, "--json"});
    ASSERT_EQ(ran.code, 1) << ran.err;
    const Json json = Json::parse(ran.out);
    EXPECT_EQ(json["contacts"].size(), 100'000u);
    EXPECT_EQ(json["contacts_left_out"], 600 * 600 - 100'000);
    // As a baseline it reports what is missing.
    const std::string old = write("old.json", ran.out).string();
    const Ran again = run({"check", file, "--baseline", old, "--pairs", "X 0:Y 1"});
    EXPECT_NE(again.out.find("note: the baseline left out 260000 contacts, which count as new"), std::string::npos)
        << again.out;
}

// These once ended with code 134, by std::bad_alloc.
TEST_F(Memory, WantOfItIsOneLine) {
    const std::string heap = grid_of_rods(1200);
    expect_one_line(run_within(60, {"check", heap, "--json"}),
                    heap + ": needs more memory than there is: --pairs selects fewer objects");
    GltfBuilder builder;
    builder.add_node("Box", builder.add_mesh("Box", test::box_triangles({1, 1, 1})));
    const std::string box = write("box.gltf", builder.text()).string();
    expect_one_line(run_within(400, {"field", box, "-o", out("a.field"), "--cell", "0.004", "--dense"}),
                    box + ": needs more memory than there is: a larger --cell needs less");
    EXPECT_FALSE(std::filesystem::exists(out("a.field")));
}

// The program itself reads a 2D level.
TEST_F(Memory, LevelsToo) {
    const std::string map = write(
                                "m.tmx",
                                "<map orientation='orthogonal' width='4000' height='4000' tilewidth='8' "
                                "tileheight='8'><layer name='L' width='4000' height='4000'>"
                                "<data encoding='csv'>" +
                                    [] {
                                        std::string tiles;
                                        for (int i = 0; i < 4000 * 4000; ++i) tiles += i % 3 == 0 ? "1," : "0,";
                                        tiles.back() = ' ';
                                        return tiles;
                                    }() +
                                    "</data></layer></map>")
                                .string();
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"check", map},
                                                 {"info", map},
                                                 {"cast", map, "--from", "0,0", "--to", "9,9"},
                                                 {"field", map, "-o", out("a.field")}}) {
        const Ran ran = run_within(100, verb);
        EXPECT_EQ(ran.code, 2) << verb[0];
        EXPECT_TRUE(ran.err.starts_with("abut: " + map + ": needs more memory than there is")) << ran.err;
        EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    }
}

}  // namespace
}  // namespace abut
