// `abut replay` as a command line.

#include "../oracle/seal.hpp"
#include "tool_runs.hpp"
#include <abut/shape/box.hpp>
#include <abut/world/recorded_world.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace abut {
namespace {

using test::Json;
using test::Ran;

class ReplayVerb : public test::ToolRuns {
protected:
    /// A crate that falls on a floor, and a ray in each frame; if `differs`, with another answer of the last ray.
    std::string session(bool differs) const {
        std::vector<std::vector<std::byte>> pieces;
        RecordedWorld3 world(
            [&](std::span<const std::byte> bytes) { pieces.emplace_back(bytes.begin(), bytes.end()); });
        world.add(HalfSpace3{{0, 1, 0}, 0}, {.fixed = true});
        const Id crate = world.add(Box3{{0, 0, 0}, {0.5f, 0.5f, 0.5f}});
        for (int frame = 0; frame < 5; ++frame) {
            world.move(crate, {{0, 2 - 0.4f * static_cast<float>(frame), 0}});
            world.update();
            EXPECT_TRUE(world.raycast({{0, 9, 0}, {0, -1, 0}, 20}));
        }
        if (differs) {
            std::vector<std::byte> last(pieces.back().begin() + 8, pieces.back().end());
            last[last.size() - 9] ^= std::byte{1};
            oracle::seal(last, 4);
            std::copy(last.begin(), last.end(), pieces.back().begin() + 8);
        }
        std::string text;
        for (const auto& piece : pieces)
            for (const std::byte byte : piece) text += static_cast<char>(byte);
        return write(differs ? "differs.rec" : "session.rec", text).string();
    }
};

TEST_F(ReplayVerb, FindsNothingInAGoodRecording) {
    const std::string file = session(false);
    const Ran ran = run({"replay", file});
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(ran.out, file + "\n\ndimension   3\nframes      5\nentries     19\nquestions   5\ndifferences 0\n");
    const Json json = json_of({"replay", file}, 0);
    EXPECT_EQ(json["questions"], 5);
    EXPECT_EQ(json["cut"], false);
}

TEST_F(ReplayVerb, ShowsTheDifferenceAndAProgram) {
    const std::string file = session(true);
    const Ran ran = run({"replay", file});
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(
        ran.out.find("entry 18, frame 5: raycast differs in hit.feature.kind\n  recorded  ..., hit.feature.part 0"),
        std::string::npos)
        << ran.out;
    EXPECT_NE(ran.out.find("int main() {\n    World<3> world;\n    world.add(Box3{"), std::string::npos);
    const Json json = json_of({"replay", file}, 1);
    EXPECT_EQ(json["difference_count"], 1);
    EXPECT_EQ(json["differences"][0]["entry"], 18);
    EXPECT_EQ(json["differences"][0]["question"], "raycast");
    EXPECT_NE(json["differences"][0]["code"], "");
}

TEST_F(ReplayVerb, RefusesOtherFilesInOneLine) {
    EXPECT_EQ(
        refusal({"replay", write("text.rec", "nothing").string()}),
        "abut: " + (folder() / "text.rec").string() + ": this is not a recording of a world: its signature is wrong");
    EXPECT_NE(refusal({"replay", (folder() / "absent.rec").string()}).find("absent.rec"), std::string::npos);
    EXPECT_NE(refusal({"replay", session(false), "--max", "none"}).find("--max"), std::string::npos);
}

}  // namespace
}  // namespace abut
