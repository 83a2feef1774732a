// Files that once took minutes or gigabytes. Each ends under one gigabyte of address space, with an answer or with the
// name of the limit. With ABUT_LONG in the environment they have the sizes that they were reported with.

#include "tool/shared/import_in_child.hpp"
#include "tool_runs.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;
using test::Triangles;

class BlowUps : public test::ToolRuns {
protected:
    void SetUp() override {
        if (!tool::limits_memory()) GTEST_SKIP() << "not in builds with sanitizers";
    }

    static int size(int quick, int full) { return std::getenv("ABUT_LONG") != nullptr ? full : quick; }

    Ran within_a_gigabyte(const std::vector<std::string>& arguments) const { return run_within(1000, arguments); }

    Json report_of(const std::vector<std::string>& arguments) const {
        const Ran ran = within_a_gigabyte(arguments);
        EXPECT_EQ(ran.code, 1) << ran.err;
        return Json::parse(ran.out, nullptr, false);
    }

    void expect_refusal(const std::vector<std::string>& arguments, const std::string& reason) const {
        const Ran ran = within_a_gigabyte(arguments);
        EXPECT_EQ(ran.code, 2);
        EXPECT_EQ(ran.out, "");
        EXPECT_NE(ran.err.find(reason), std::string::npos) << ran.err;
        EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    }

    std::string map(int size, const std::function<bool(int, int)>& is_full) const {
        const std::string side = std::to_string(size);
        std::string text = "<map orientation='orthogonal' width='" + side + "' height='" + side +
                           "' tilewidth='8' tileheight='8'><layer name='L' width='" + side + "' height='" + side +
                           "'><data encoding='csv'>";
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) text += is_full(x, y) ? "1," : "0,";
        text.back() = ' ';
        return write("map.tmx", text + "</data></layer></map>").string();
    }

    std::string curves(int count, const std::string& fill, bool as_one_path) const {
        std::mt19937 random(3);
        const auto numbers = [&](int how_many) {
            std::string text;
            for (int i = 0; i < how_many; ++i) text += std::to_string(random() % 1000) + " ";
            return text;
        };
        std::string text = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1000 1000'>";
        const std::string path = "<path fill='" + fill + "' stroke='black' d='M";
        if (as_one_path) text += path + numbers(2);
        for (int i = 0; i < count; ++i)
            text += as_one_path ? "C" + numbers(6) : path + numbers(2) + "C" + numbers(6) + "'/>";
        return write("curves.svg", text + (as_one_path ? "'/>" : "") + "</svg>").string();
    }
};

// 3,000 equal boxes took 5 GB, and later 115 seconds, and were reported as 100,000 contacts.
TEST_F(BlowUps, PileOfEqualObjectsIsOneFinding) {
    const int count = size(600, 3000);
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    for (int i = 0; i < count; ++i) builder.add_node("Box " + std::to_string(i), mesh);
    const Json json = report_of({"check", write("pile.gltf", builder.text()).string(), "--json"});
    ASSERT_EQ(json["piles"].size(), 1u);
    EXPECT_EQ(json["piles"][0]["objects"].size(), static_cast<std::size_t>(count));
    EXPECT_EQ(json["piles"][0]["pairs"], count * (count - 1) / 2);
    EXPECT_EQ(json["contacts"].size(), 0u);
    EXPECT_EQ(json["duplicates"].size(), 1u);
}

TEST_F(BlowUps, PileOfDifferentObjectsToo) {
    const int count = size(500, 3000);
    GltfBuilder builder;
    std::mt19937 random(7);
    const auto half = [&] { return 0.3f + 0.001f * static_cast<float>(random() % 300); };
    for (int i = 0; i < count; ++i) {
        const std::string name = "Box " + std::to_string(i);
        builder.add_node(name, builder.add_mesh(name, box_triangles({half(), half(), half()})));
    }
    // One is beside the pile, and overlaps many of it without its middle.
    builder.add_node("Beside", builder.add_mesh("Beside", box_triangles({0.5f, 0.1f, 0.1f})), {0.7f, 0, 0});
    const Json json = report_of({"check", write("pile.gltf", builder.text()).string(), "--json"});
    ASSERT_EQ(json["piles"].size(), 1u);
    EXPECT_EQ(json["piles"][0]["objects"].size(), static_cast<std::size_t>(count));
    EXPECT_EQ(json["contacts"].size(), static_cast<std::size_t>(count)) << "those with the one beside";
    EXPECT_GT(json["piles"][0]["depth"].get<double>(), 0.5);
}

// 719,400 pairs of objects around a point that none of them contains are reported one by one, but not more than 4
// million. Of 20,000 lines, each 200 of which are equal, the search for duplicates listed all pairs, which took 5 GB.
TEST_F(BlowUps, MorePairsThanTheLimitAreRefused) {
    std::string drawing = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 1000 1000'>";
    for (int i = 0; i < size(3000, 20'000); ++i)
        drawing += "<path fill='none' stroke='black' d='M0 " + std::to_string(i % 100) + "L1000 1000'/>";
    const std::string file = write("lines.svg", drawing + "</svg>").string();
    expect_refusal({"check", file}, "more than 4194304 pairs of objects overlap, the limit: --pairs selects fewer");
}

// 20,000 curves took 14.7 GB, and 1,000 of them 41 seconds.
TEST_F(BlowUps, OutlineThatCrossesItselfTooOftenIsRefused) {
    expect_refusal({"check", curves(size(1000, 20'000), "red", true)},
                   "its outline crosses itself more than 65536 times, the limit");
    expect_refusal({"field", curves(size(1000, 20'000), "red", true), "-o", out("a.field")},
                   "crosses itself more than 65536 times, the limit");
    EXPECT_NE(within_a_gigabyte({"check", curves(size(1000, 20'000), "none", true)}).code, 2);
}

// 16 million full tiles took 8 GB and 70 seconds.
TEST_F(BlowUps, FullMapHasAShortOutline) {
    const std::string file = map(size(1024, 4096), [](int, int) { return true; });
    EXPECT_EQ(within_a_gigabyte({"check", file, "--character", "6,24"}).code, 0);
}

TEST_F(BlowUps, OutlineWithTooManyEdgesIsRefused) {
    const std::string file = map(size(2048, 4096), [](int x, int y) { return (x + y) % 2 == 0; });
    expect_refusal({"check", file}, "object 'L': its outline has more than 4194304 edges, the limit");
}

// A cone with notches, of triangles that share a corner: 10,000 of them took 82 seconds against a cube.
TEST_F(BlowUps, FanAboutOneCornerAgainstACube) {
    const int sides = size(1000, 5000);
    Triangles fan;
    fan.points = {{0, 0, 1}, {0, 0, 0}};
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides, radius = i % 2 == 0 ? 0.9 : 1;
        fan.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
        const std::uint32_t next = (i + 1) % static_cast<std::uint32_t>(sides);
        fan.triangles.emplace_back(0, 2 + i, 2 + next);
        fan.triangles.emplace_back(1, 2 + next, 2 + i);
    }
    GltfBuilder builder;
    builder.add_node("Fan", builder.add_mesh("Fan", fan));
    builder.add_node("Cube", builder.add_mesh("Cube", box_triangles({0.4f, 0.4f, 0.4f})), {0.1f, 0.05f, 0.8f});
    const Json json = report_of({"check", write("fan.gltf", builder.text()).string(), "--json", "--only", "contact"});
    ASSERT_EQ(json["contacts"].size(), 1u);
    EXPECT_NEAR(json["contacts"][0]["distance"].get<double>(), -0.6, 1e-6);
}

// 4,000 boxes took 57 seconds: all pairs of parts were merged for a try.
TEST_F(BlowUps, DecompositionOfManyParts) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({0.4f, 0.4f, 0.4f}));
    for (int i = 0; i < size(1000, 4000); ++i)
        builder.add_node("Box " + std::to_string(i), mesh,
                         {static_cast<float>(i % 16), static_cast<float>(i / 16 % 16), static_cast<float>(i / 256)});
    const std::string file = write("boxes.gltf", builder.text()).string();
    const Ran ran = within_a_gigabyte({"decompose", file, "-o", out("parts.glb"), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_LE(Json::parse(ran.out)["parts"].size(), 32u);
}

// A chain of 100,000 nodes took 9 seconds to refuse.
TEST_F(BlowUps, DeepChainOfNodesIsRefused) {
    GltfBuilder builder;
    const int count = size(20'000, 100'000);
    const int mesh = builder.add_mesh("Box", box_triangles({1, 1, 1}));
    for (int i = 0; i < count; ++i)
        builder.add_node("", ",\"mesh\":" + std::to_string(mesh) +
                                 (i + 1 < count ? ",\"children\":[" + std::to_string(i + 1) + "]" : ""));
    expect_refusal({"info", write("chain.gltf", builder.text()).string()},
                   "node tree is " + std::to_string(count) + " deep; the limit is 1000");
}

}  // namespace
}  // namespace abut
