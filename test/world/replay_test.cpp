// A recording replays with the same answers; a changed answer is found, with a program for it; other files are refused.

#include "../oracle/seal.hpp"
#include "support/recording.hpp"
#include <abut/world/file.hpp>
#include <abut/world/replay.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <int D>
Pieces recorded(std::uint64_t seed, int steps, const WorldOptions& options = {}) {
    Session<D> session(seed, options);
    for (int i = 0; i < steps; ++i) session.step();
    session.questions();
    EXPECT_FALSE(session.world().problem());
    return session.pieces;
}

std::string problem_of(std::span<const std::byte> bytes) {
    const Result<ReplayReport> report = replay(bytes);
    if (report) return "";
    EXPECT_EQ(report.problem().code, ProblemCode::bad_format);
    EXPECT_EQ(report.problem().message.find('\n'), std::string::npos);
    return report.problem().message;
}

template <int D>
void expect_same_answers(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pieces pieces = recorded<D>(seed, 300, {.filter_edges = seed % 2 == 0, .max_released_shapes = 3});
    const Result<ReplayReport> report = replay(joined(pieces));
    ASSERT_TRUE(report) << report.problem().message;
    for (const ReplayDifference& each : report->differences)
        ADD_FAILURE() << each.entry << " " << each.question << ": " << each.recorded << "\n" << each.now;
    EXPECT_EQ(report->difference_count, 0u);
    EXPECT_EQ(report->dimension, D);
    EXPECT_EQ(report->entries, pieces.size() - 1);
    EXPECT_GT(report->questions, 300u);
    EXPECT_GT(report->frames, 5u);
    EXPECT_FALSE(report->is_cut);
}

TEST(Replay, GivesTheRecordedAnswers) {
    for (std::uint64_t seed = 900; seed < 906; ++seed) {
        expect_same_answers<2>(seed);
        expect_same_answers<3>(seed);
    }
}

/// Changes a byte of an entry and its checksum. The byte is counted from the end of the answer.
std::vector<std::byte> changed(std::vector<std::byte> piece, std::size_t from_end) {
    std::vector<std::byte> payload(piece.begin() + 8, piece.end());
    std::byte& byte = payload[payload.size() - 9 - from_end];
    byte ^= std::byte{1};
    oracle::seal(payload, 4);
    std::copy(payload.begin(), payload.end(), piece.begin() + 8);
    return piece;
}

template <int D>
void expect_each_changed_answer_found(std::uint64_t seed) {
    const Pieces pieces = recorded<D>(seed, 60);
    std::set<std::string> questions;
    int programs = 0;
    constexpr int first_question = 9;  // of the kinds of entries
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        const int kind = std::to_integer<int>(pieces[i][8]);
        if (kind < first_question) continue;
        SCOPED_TRACE("entry " + std::to_string(i - 1) + " of kind " + std::to_string(kind));
        Pieces other = pieces;
        other[i] = changed(other[i], 0);
        const Result<ReplayReport> report = replay(joined(other));
        ASSERT_TRUE(report) << report.problem().message;
        ASSERT_EQ(report->difference_count, 1u);
        ASSERT_EQ(report->differences.size(), 1u);
        const ReplayDifference& found = report->differences[0];
        EXPECT_EQ(found.entry, i - 1);
        EXPECT_FALSE(found.field.empty());
        EXPECT_NE(found.recorded, found.now);
        questions.insert(found.question);
        if (found.code.empty()) continue;
        EXPECT_NE(found.code.find("world." + found.question + "("), std::string::npos) << found.code;
        EXPECT_EQ(found.code.find("depends on what happened before"), std::string::npos) << found.code;
        ++programs;
    }
    EXPECT_EQ(questions,
              (std::set<std::string>{"closest", "contact", "containing", "each_contact", "impact", "k_nearest",
                                     "overlapping", "raycast", "raycast_all", "raycast_any", "sweep", "touching"}));
    EXPECT_GT(programs, 50);
}

TEST(Replay, FindsEachChangedAnswer) {
    expect_each_changed_answer_found<2>(910);
    expect_each_changed_answer_found<3>(911);
}

TEST(Replay, HasAShortProgramForADifference) {
    Pieces pieces;
    RecordedWorld2 world([&](std::span<const std::byte> bytes) { pieces.emplace_back(bytes.begin(), bytes.end()); });
    for (int i = 0; i < 100; ++i) world.add(Circle{{0, 0}, 0.5f}, {.pose = {{static_cast<float>(2 * i), 0}}});
    world.update();
    ASSERT_TRUE(world.raycast({{7, -5}, {0, 1}, 10}) == std::nullopt);
    ASSERT_TRUE(world.raycast({{8, -5}, {0, 1}, 10}));
    pieces.back() = changed(pieces.back(), 0);
    const Result<ReplayReport> report = replay(joined(pieces));
    ASSERT_TRUE(report);
    ASSERT_EQ(report->differences.size(), 1u);
    const ReplayDifference& found = report->differences[0];
    EXPECT_EQ(found.frame, 1u);
    EXPECT_EQ(found.field, "hit.feature.kind");
    EXPECT_EQ(found.code,
              "#include <abut/abut.hpp>\n"
              "\n"
              "#include <cstdio>\n"
              "#include <limits>\n"
              "\n"
              "using namespace abut;\n"
              "\n"
              "int main() {\n"
              "    World<2> world;\n"
              "    world.add(Ball<2>{{0x0p+0f, 0x0p+0f}, 0x1p-1f}, {.pose = {{0x1p+3f, 0x0p+0f}, Turn{0x1p+0f, "
              "0x0p+0f}}});  // item 1, in the recording 5\n"
              "    const auto answer = world.raycast(Ray2{{0x1p+3f, -0x1.4p+2f}, {0x0p+0f, 0x1p+0f}, 0x1.4p+3f}, {});\n"
              "    if (answer)\n"
              "        std::printf(\"item %u, fraction %a, distance %a, normal %a %a\\n\", answer->id.index, "
              "answer->hit.fraction, answer->hit.distance, answer->hit.normal.x, answer->hit.normal.y);\n"
              "    else\n"
              "        std::puts(\"none\");\n"
              "}\n");
}

TEST(Replay, FindsAnUpdateThatDiffers) {
    Pieces pieces;
    RecordedWorld3 world([&](std::span<const std::byte> bytes) { pieces.emplace_back(bytes.begin(), bytes.end()); });
    world.add(Sphere{{0, 0, 0}, 1});
    world.add(Sphere{{1, 0, 0}, 1});
    world.update();
    pieces.back() = changed(pieces.back(), 95);  // the number of pairs that began
    const Result<ReplayReport> report = replay(joined(pieces));
    ASSERT_TRUE(report);
    ASSERT_EQ(report->differences.size(), 1u);
    EXPECT_EQ(report->differences[0].question, "update");
    EXPECT_EQ(report->differences[0].field, "began.size");
    EXPECT_NE(report->differences[0].code.find("world.update()"), std::string::npos);
}

TEST(Replay, PlaysUpToACut) {
    const Pieces pieces = recorded<2>(920, 40);
    std::vector<std::byte> bytes = pieces[0];
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        const Result<ReplayReport> whole = replay(bytes);
        ASSERT_TRUE(whole);
        EXPECT_FALSE(whole->is_cut);
        EXPECT_EQ(whole->entries, i - 1);
        for (const std::size_t part : {std::size_t{1}, pieces[i].size() / 2, pieces[i].size() - 1}) {
            std::vector<std::byte> cut = bytes;
            cut.insert(cut.end(), pieces[i].begin(), pieces[i].begin() + static_cast<std::ptrdiff_t>(part));
            const Result<ReplayReport> report = replay(cut);
            ASSERT_TRUE(report);
            EXPECT_TRUE(report->is_cut);
            EXPECT_EQ(report->entries, i - 1);
            EXPECT_EQ(report->difference_count, 0u);
        }
        bytes.insert(bytes.end(), pieces[i].begin(), pieces[i].end());
    }
}

TEST(Replay, RefusesOtherFiles) {
    const Pieces pieces = recorded<3>(930, 6);
    const std::vector<std::byte> bytes = joined(pieces);
    EXPECT_EQ(problem_of({}), "this is not a recording of a world: its signature is wrong");
    World3 world;
    EXPECT_EQ(problem_of(*save_with_shapes(world)), "this is not a recording of a world: its signature is wrong");
    for (std::size_t size = 8; size < pieces[0].size(); ++size)
        ASSERT_EQ(problem_of(std::span(bytes).first(size)), "the recording is truncated before its first entry");
    for (std::size_t i = 0; i < bytes.size(); i += 1 + i / 100) {
        std::vector<std::byte> damaged = bytes;
        damaged[i] ^= std::byte{static_cast<unsigned char>(1u << i % 8)};
        ASSERT_NE(problem_of(damaged), "") << i;
    }
    std::vector<std::byte> later = bytes;
    later[8] = std::byte{9};
    EXPECT_EQ(problem_of(later), "the recording has version 9 and dimension 3, not version 1 and dimension 2 or 3");
}

TEST(RecordedWorld, EndsAtAShapeThatNoFileCanHold) {
    Pieces pieces;
    RecordedWorld2 world([&](std::span<const std::byte> bytes) { pieces.emplace_back(bytes.begin(), bytes.end()); });
    const Id ball = world.add(Circle{{0, 0}, 1});
    (void)world.overlapping(Diamond<2>{{0, 0}, 1});  // left out
    EXPECT_FALSE(world.problem());
    const std::size_t size = pieces.size();
    world.add(Diamond<2>{{0, 0}, 1});
    ASSERT_TRUE(world.problem());
    EXPECT_EQ(world.problem()->message, "item 2 has a shape of a kind that can't be saved");
    world.move(ball, {{1, 1}});
    EXPECT_EQ(world.update().began.size(), 1u);
    EXPECT_EQ(pieces.size(), size);
    EXPECT_EQ(replay(joined(pieces))->difference_count, 0u);
}

}  // namespace
}  // namespace abut::test
