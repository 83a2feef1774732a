// Kinds, severities and selection of findings, as a command line.

#include "tool/check/rule.hpp"
#include "tool_runs.hpp"

#include <set>
#include <string_view>

namespace abut::tool {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;

class Rules : public test::ToolRuns {
protected:
    /// Crates along x at these places, and above them a bar with a small hole.
    std::string crates_at(const std::vector<float>& xs) const {
        GltfBuilder builder;
        const int mesh = builder.add_mesh("Crate", box_triangles({0.5f, 0.5f, 0.5f}));
        for (std::size_t i = 0; i < xs.size(); ++i) builder.add_node("Crate " + std::to_string(i), mesh, {xs[i], 0, 0});
        builder.add_node("Leaky", builder.add_mesh("Leaky", leaky()), {0, 9, 0});
        return write("crates.gltf", builder.text()).string();
    }

private:
    /// A bar of three sides in sections; a side of one section is missing, less than a twentieth of the surface.
    static test::Triangles leaky() {
        test::Triangles bar;
        constexpr int count = 60;
        for (int i = 0; i < count; ++i) {
            const float x = static_cast<float>(i);
            bar.points.emplace_back(x, 0.0f, 0.0f);
            bar.points.emplace_back(x, 1.0f, 0.0f);
            bar.points.emplace_back(x, 0.5f, 1.0f);
        }
        const auto corner = [](int section, int k) { return static_cast<std::uint32_t>(3 * section + k % 3); };
        for (int i = 0; i + 1 < count; ++i)
            for (int k = 0; k < 3; ++k) {
                if (i == 7 && k == 1) continue;
                bar.triangles.emplace_back(corner(i, k), corner(i + 1, k), corner(i + 1, k + 1));
                bar.triangles.emplace_back(corner(i, k), corner(i + 1, k + 1), corner(i, k + 1));
            }
        bar.triangles.emplace_back(corner(0, 0), corner(0, 1), corner(0, 2));
        bar.triangles.emplace_back(corner(count - 1, 0), corner(count - 1, 2), corner(count - 1, 1));
        return bar;
    }
};

TEST(RuleTable, CodesAreUniqueAndInTheOrderOfRules) {
    std::set<std::string_view> codes, names;
    for (std::size_t i = 0; i < count_rules; ++i) {
        const RuleInfo& rule = all_rules()[i];
        EXPECT_EQ(static_cast<std::size_t>(rule.rule), i);
        EXPECT_TRUE(codes.insert(rule.code).second) << rule.code;
        EXPECT_TRUE(names.insert(rule.name).second) << rule.name;
        EXPECT_TRUE(names_rule(rule.code, rule));
        EXPECT_TRUE(names_rule(name_of(rule.kind), rule));
    }
    EXPECT_TRUE(names_any_rule("ABUT6*"));
    EXPECT_FALSE(names_any_rule("ABUT9*"));
    EXPECT_FALSE(names_any_rule("leaks"));
}

TEST_F(Rules, LeaksAreWarningsAndExitWith0) {
    const std::string file = crates_at({0, 5});
    const Json json = checked({file}, 0);
    EXPECT_EQ(json["verdict"], "warnings");
    EXPECT_EQ(json["counts"], Json({{"errors", 0}, {"warnings", 1}}));
    ASSERT_EQ(json["leaks"].size(), 1u) << json;
    EXPECT_EQ(json["leaks"][0]["code"], "ABUT601");
    EXPECT_EQ(json["leaks"][0]["severity"], "warning");
    EXPECT_EQ(checked({file, "--warnings-as-errors"}, 1)["verdict"], "errors");
    EXPECT_EQ(checked({file, "--severity", "leak=error"}, 1)["verdict"], "errors");
    EXPECT_EQ(checked({file, "--severity", "ABUT601=off"}, 0)["verdict"], "clean");
    EXPECT_EQ(checked({file, "--closed", "Leaky"}, 1)["leaks"][0]["severity"], "error");
    EXPECT_EQ(checked({file, "--no", "leak"}, 0)["verdict"], "clean");
    const Ran ran = run({"check", file});
    EXPECT_EQ(ran.code, 0);
    EXPECT_NE(ran.out.find("NO ERRORS, BUT WARNINGS: 1 leak\n"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("warnings: leaks (ABUT601)\n   1. Leaky\n"), std::string::npos) << ran.out;
}

TEST_F(Rules, OnlyAndNo) {
    const std::string file = crates_at({0, 0.75f, 5, 5});
    const Json all = checked({file}, 1);
    EXPECT_EQ(all["contacts"].size(), 2u);
    EXPECT_EQ(all["duplicates"].size(), 1u);
    EXPECT_EQ(all["leaks"].size(), 1u);
    const Json only = checked({file, "--only", "duplicate"}, 1);
    EXPECT_EQ(only["contacts"].size(), 0u);
    EXPECT_EQ(only["pairs"], 0) << "no pair is tested";
    EXPECT_EQ(only["duplicates"].size(), 1u);
    EXPECT_EQ(only["leaks"].size(), 0u);
    EXPECT_EQ(checked({file, "--only", "contact", "--only", "leak"}, 1)["duplicates"].size(), 0u);
    const Json no = checked({file, "--no", "ABUT1*", "--no", "duplicate"}, 0);
    EXPECT_EQ(no["contacts"].size(), 0u);
    EXPECT_EQ(no["leaks"].size(), 1u);
    EXPECT_EQ(refusal({"check", file, "--only", "leaks"}),
              "abut: --only: 'leaks' is no kind and no code; the kinds are spawn, inside, contact, gap, "
              "duplicate, leak, floating");
    EXPECT_EQ(refusal({"check", file, "--severity", "leak=fatal"}),
              "abut: --severity: 'leak=fatal' is no KIND=SEVERITY, such as leak=error; the severities "
              "are off, warning and error");
}

TEST_F(Rules, IgnoreTakesPairsObjectsAndCodes) {
    const std::string file = crates_at({0, 0.75f, 1.5f});
    EXPECT_EQ(checked({file}, 1)["contacts"].size(), 2u);
    const Json pair = checked({file, "--ignore", "Crate 1:Crate 0"}, 1);
    EXPECT_EQ(pair["contacts"].size(), 1u);
    EXPECT_EQ(pair["ignored"], 1);
    EXPECT_EQ(checked({file, "--ignore", "Crate 1"}, 0)["ignored"], 2);
    EXPECT_EQ(checked({file, "--ignore", "Crate*:Crate*"}, 0)["ignored"], 2);
    EXPECT_EQ(checked({file, "--ignore", "ABUT101 Crate*"}, 0)["ignored"], 2);
    EXPECT_EQ(checked({file, "--ignore", "ABUT6* Crate*"}, 1)["ignored"], 0);
    EXPECT_EQ(checked({file, "--ignore", "ABUT6* *"}, 1)["leaks"].size(), 0u);
    const Json unused = checked({file, "--ignore", "Barrel:*"}, 1);
    ASSERT_EQ(unused["warnings"].size(), 1u);
    EXPECT_EQ(unused["warnings"][0], "--ignore: 'Barrel:*' matches no finding");
    EXPECT_EQ(refusal({"check", file, "--ignore", "a:b:c"}),
              "abut: --ignore: 'a:b:c' is not one pattern, or two with one ':' between them (a ':' in a "
              "name is matched by '?'), after a code and a blank or alone");
}

TEST_F(Rules, ObjectsOfOneBodyMayOverlap) {
    GltfBuilder builder;
    const int mesh = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    builder.add_node("Lamp", ",\"children\":[1,2]");
    builder.add_node("Stand", mesh);
    builder.add_node("Shade", mesh, {0, 0.75f, 0});
    builder.add_node("Wall", mesh, {0.75f, 0, 0});
    builder.add_text(",\"scenes\":[{\"nodes\":[0,3]}],\"scene\":0");
    const std::string file = write("lamp.gltf", builder.text()).string();
    EXPECT_EQ(checked({file}, 1)["contacts"].size(), 3u);
    const Json body = checked({file, "--body", "Lamp"}, 1);
    EXPECT_EQ(body["contacts"].size(), 2u) << body["contacts"];
    EXPECT_EQ(body["possible_pairs"], 2);
    EXPECT_EQ(refusal({"check", file, "--body", "Sofa"}), "abut: " + file + ": --body: no node is named 'Sofa'");
}

TEST_F(Rules, FloatingIsOffUnlessSelected) {
    GltfBuilder builder;
    builder.add_node("Floor", builder.add_mesh("Floor", box_triangles({9, 0.5f, 9})));
    const int mesh = builder.add_mesh("Box", box_triangles({0.5f, 0.5f, 0.5f}));
    builder.add_node("Standing", mesh, {3, 1, 0});
    builder.add_node("Stacked", mesh, {3, 2, 0});
    builder.add_node("Hovebar", mesh, {-3, 1.5f, 0});
    const std::string file = write("floor.gltf", builder.text()).string();
    EXPECT_EQ(checked({file}, 0)["floating"].size(), 0u);
    for (const std::vector<std::string>& option :
         std::vector<std::vector<std::string>>{{"--only", "floating"}, {"--severity", "floating=warning"}}) {
        const Json json = checked({file, option[0], option[1]}, 0);
        ASSERT_EQ(json["floating"].size(), 1u) << json;
        EXPECT_EQ(json["floating"][0]["object"], "Hovebar");
        EXPECT_EQ(json["floating"][0]["nearest"], "Floor");
        EXPECT_NEAR(json["floating"][0]["distance"].get<double>(), 0.5, 1e-5);
    }
    EXPECT_EQ(checked({file, "--severity", "floating=error"}, 1)["floating"].size(), 1u);
}

TEST_F(Rules, TheBaselineNamesWhatIsMendedAndStale) {
    const std::string old =
        write("old.json", run({"check", "--json", crates_at({0, 0.75f, 5, 5.75f, 9, 9.5f})}).out).string();
    // The first pair still collides, the second is mended, one of the third is gone.
    const Json json = checked({crates_at({0, 0.75f, 5, 6.5f, 9}), "--baseline", old}, 0);
    EXPECT_EQ(json["known"], 2) << "a pair and a leak";
    EXPECT_EQ(json["mended"], Json({"contacts: Crate 2 and Crate 3"}));
    EXPECT_EQ(json["stale"], Json({"contacts: Crate 4 and Crate 5"}));
    const Ran ran = run({"check", crates_at({0, 0.75f, 5, 6.5f, 9}), "--baseline", old});
    EXPECT_NE(ran.out.find("mended since the baseline\n      contacts: Crate 2 and Crate 3\n"), std::string::npos)
        << ran.out;
    // What isn't checked now is neither.
    const Json only = checked({crates_at({0, 0.75f, 5, 6.5f, 9}), "--baseline", old, "--only", "leak"}, 0);
    EXPECT_EQ(only["mended"], Json::array());
}

}  // namespace
}  // namespace abut::tool
