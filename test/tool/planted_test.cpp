// A furnished room with one fault of each kind: all are found, and nothing else.

#include "tool_runs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace abut {
namespace {

using test::box_triangles;
using test::GltfBuilder;
using test::Json;
using test::Ran;
using test::Triangles;

// A closed barrel of 24 staves that stands on the origin; `open` leaves out a triangle of its lid.
Triangles barrel(float radius, float height, bool open) {
    constexpr std::uint32_t count = 24;
    Triangles result;
    for (const float y : {0.0f, height})
        for (std::uint32_t i = 0; i < count; ++i) {
            const double angle = 2 * 3.14159265358979 * i / count;
            result.points.emplace_back(radius * static_cast<float>(std::cos(angle)), y,
                                       radius * static_cast<float>(std::sin(angle)));
        }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        result.triangles.emplace_back(i, count + i, count + next);
        result.triangles.emplace_back(i, count + next, next);
    }
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
        result.triangles.emplace_back(0, i, i + 1);
        if (!open || i != 1) result.triangles.emplace_back(count, count + i + 1, count + i);
    }
    return result;
}

class PlantedFaults : public test::ToolRuns {
protected:
    /// The room without faults, and names of faults to plant in it.
    std::string room(const std::vector<std::string>& faults) {
        builder_ = {};
        roots_.clear();
        const auto has = [&](const char* fault) {
            return std::find(faults.begin(), faults.end(), fault) != faults.end();
        };
        box("Floor", {6, 0.1f, 4}, {0, -0.1f, 0});
        box("Wall north", {6, 1.5f, 0.1f}, {0, 1.5f, -4.1f});
        box("Wall south", {6, 1.5f, 0.1f}, {0, 1.5f, 4.1f});
        box("Wall west", {0.1f, 1.5f, 4}, {-6.1f, 1.5f, 0});
        box("Wall east", {0.1f, 1.5f, 4}, {6.1f, 1.5f, 0});
        box("Ceiling", {6.2f, 0.1f, 4.2f}, {0, 3.1f, 0});
        for (int i = 0; i < 3; ++i) table(i, {-3.5f + 2.5f * static_cast<float>(i), 0, -2.5f});
        for (int i = 0; i < 6; ++i)
            box("Crate " + std::to_string(i), {0.4f, 0.4f, 0.4f},
                {5.6f, 0.4f + 0.8f * static_cast<float>(i % 2), -3.6f + 1.8f * static_cast<float>(i / 2)});
        const int keg = builder_.add_mesh("Barrel", barrel(0.3f, 0.9f, false));
        for (int i = 0; i < 4; ++i) {
            const bool sinks = has("contact") && i == 2;
            node("Barrel " + std::to_string(i), keg, {-5 + 1.5f * static_cast<float>(i), 0, sinks ? 3.9f : 3.7f});
        }
        const int chair = builder_.add_mesh("Chair", box_triangles({0.2f, 0.4f, 0.2f}));
        node("Chair", chair, {-4.5f, 0.4f, 0});
        node("Cart", builder_.add_mesh("Cart", box_triangles({0.3f, 0.3f, 0.3f})), {-2, 0.3f, 1.5f});
        builder_.add_motion(roots_.back(), "Drive", {0, 1}, {{-2, 0.3f, 1.5f}, {2, 0.3f, 1.5f}});
        roots_.push_back(builder_.add_node("Spawn", ",\"translation\":[-1,0,0]"));

        if (has("between")) box("Bin", {0.1f, 0.1f, 0.1f}, {0, 0.1f, 1.5f});
        if (has("duplicate")) node("Chair again", chair, {-4.5f, 0.4f, 0});
        if (has("inside")) box("Coin", {0.05f, 0.01f, 0.05f}, {5.6f, 0.4f, 0});
        if (has("spawn")) roots_.push_back(builder_.add_node("Spawn 2", ",\"translation\":[5.6,0,0]"));
        if (has("gap")) {
            // A door 0.4 wide to the part with the crates.
            box("Partition", {0.1f, 1.5f, 1.8f}, {3.3f, 1.5f, -2.2f});
            box("Partition 2", {0.1f, 1.5f, 2}, {3.3f, 1.5f, 2});
        }
        if (has("leak")) node("Vase", builder_.add_mesh("Vase", barrel(0.1f, 0.3f, true)), {-1, 0.8f, -2.5f});
        if (has("floating")) box("Lamp", {0.1f, 0.1f, 0.1f}, {-3.5f, 1.5f, -2.5f});
        std::string roots;
        for (const int root : roots_) roots += (roots.empty() ? "" : ",") + std::to_string(root);
        builder_.add_text(",\"scenes\":[{\"nodes\":[" + roots + "]}],\"scene\":0");
        return write("room.gltf", builder_.text()).string();
    }

    static std::vector<std::string> options() { return {"--character", "0.3,1.8", "--severity", "floating=warning"}; }
    Json report(const std::string& file, int code) const {
        std::vector<std::string> arguments = options();
        arguments.insert(arguments.begin(), file);
        return checked(arguments, code);
    }

private:
    void node(const std::string& name, int mesh, const Vec3& at) {
        roots_.push_back(builder_.add_node(name, mesh, at));
    }
    void box(const std::string& name, const Vec3& half, const Vec3& at) {
        node(name, builder_.add_mesh(name, box_triangles(half)), at);
    }
    /// A table of five parts, 0.8 high.
    void table(int number, const Vec3& at) {
        const int top = builder_.add_mesh("Top", box_triangles({0.6f, 0.05f, 0.4f}));
        const int leg = builder_.add_mesh("Leg", box_triangles({0.05f, 0.35f, 0.05f}));
        std::string children = std::to_string(builder_.add_node("Top", top, {0, 0.75f, 0}));
        for (const float x : {-0.5f, 0.5f})
            for (const float z : {-0.3f, 0.3f})
                children += "," + std::to_string(builder_.add_node("Leg", leg, {x, 0.35f, z}));
        roots_.push_back(builder_.add_node("Table " + std::to_string(number),
                                           ",\"translation\":[" + std::to_string(at.x) + ",0," + std::to_string(at.z) +
                                               "],\"children\":[" + children + "]"));
    }

    GltfBuilder builder_;
    std::vector<int> roots_;
};

TEST_F(PlantedFaults, ARoomWithoutFaultsIsClean) {
    const Json json = report(room({}), 0);
    EXPECT_EQ(json["verdict"], "clean") << json.dump(1);
    EXPECT_EQ(json["objects"], 33);
}

TEST_F(PlantedFaults, EachIsFoundAlone) {
    const std::map<std::string, std::pair<std::string, std::string>> planted{
        {"contact", {"contacts", "ABUT101"}}, {"between", {"contacts", "ABUT103"}},
        {"inside", {"contacts", "ABUT201"}},  {"spawn", {"spawns", "ABUT301"}},
        {"gap", {"gaps", "ABUT401"}},         {"duplicate", {"duplicates", "ABUT501"}},
        {"leak", {"leaks", "ABUT601"}},       {"floating", {"floating", "ABUT701"}},
    };
    for (const auto& [fault, expected] : planted) {
        SCOPED_TRACE(fault);
        const bool is_warning = fault == "leak" || fault == "floating";
        const Json json = report(room({fault}), is_warning ? 0 : 1);
        ASSERT_EQ(json[expected.first].size(), 1u) << json.dump(1);
        EXPECT_EQ(json[expected.first][0]["code"], expected.second);
        // A solid that is there twice also touches itself.
        const std::size_t others = fault == "duplicate" ? 1 : 0;
        EXPECT_EQ(json["counts"]["errors"].get<std::size_t>() + json["counts"]["warnings"].get<std::size_t>(),
                  1 + others)
            << json.dump(1);
    }
}

TEST_F(PlantedFaults, AllAreFoundTogetherWithTheErrorsFirst) {
    const std::string file = room({"contact", "between", "inside", "spawn", "gap", "duplicate", "leak", "floating"});
    const Json json = report(file, 1);
    EXPECT_EQ(json["counts"], Json({{"errors", 7}, {"warnings", 2}})) << json.dump(1);
    std::vector<std::string> arguments = options();
    arguments.insert(arguments.begin(), {"check", file});
    const std::string text = run(arguments).out;
    std::size_t last = 0;
    for (const char* heading :
         {"FAULTS FOUND: ", "spawns (ABUT301)\n", "contacts (ABUT101, ABUT103)\n", "gaps (ABUT401)\n",
          "duplicates (ABUT501)\n", "warnings: leaks (ABUT601)\n", "warnings: floating objects (ABUT701)\n"}) {
        const std::size_t at = text.find(heading);
        ASSERT_NE(at, std::string::npos) << heading << " in\n" << text;
        EXPECT_GT(at + 1, last) << heading;
        last = at;
    }
}

}  // namespace
}  // namespace abut
