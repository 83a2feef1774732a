// The readers of real levels: small generated files, truncated at every byte and corrupted; and all levels of the
// packages, if they are installed.

#include "../oracle/random.hpp"
#include "real_levels.hpp"

#include <bit>
#include <cstring>
#include <iostream>
#include <limits>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

class Bytes {
public:
    void i32(std::int64_t number) { put(static_cast<std::uint64_t>(number), 4); }
    void u16(std::int64_t number) { put(static_cast<std::uint64_t>(number), 2); }
    void f32(float number) { put(std::bit_cast<std::uint32_t>(number), 4); }
    void zeros(std::size_t count) { bytes_.insert(bytes_.end(), count, '\0'); }
    void text(std::string_view text, std::size_t size) {
        const std::size_t begin = bytes_.size();
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        bytes_.resize(begin + size, '\0');
    }
    std::size_t size() const { return bytes_.size(); }
    const std::vector<char>& all() const { return bytes_; }

private:
    void put(std::uint64_t number, int count) {
        for (int i = 0; i < count; ++i) bytes_.push_back(static_cast<char>(number >> (8 * i) & 0xff));
    }

    std::vector<char> bytes_;
};

/// A static cube of edge 2, one as a detail and one as a lift, with one record of each skipped kind.
std::vector<char> small_level() {
    Bytes out;
    out.i32(0x4c4f53af);
    out.i32(8);
    // Text, words, materials, points, edges, sides, ..., brushes, nodes, stops, bodies, items, goals, ...
    for (const int count : {5, 1, 2, 8, 1, 6, 1, 1, 1, 3, 1, 2, 2, 1, 1, 1, 1, 1, 1, 1, 15}) out.i32(count);
    out.text("hello", 5);
    out.zeros(8);
    for (const bool alpha_test : {false, true}) {
        out.zeros(17 * 4);
        out.i32(alpha_test ? 1 << 9 : 0);
        out.zeros(alpha_test ? 72 : 64);
    }
    for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis) out.f32(i >> axis & 1 ? 1.0f : -1.0f);
    out.i32(0), out.i32(1);
    for (int i = 0; i < 6; ++i) {
        for (int axis = 0; axis < 3; ++axis) out.f32(i / 2 == axis ? (i % 2 == 0 ? 1.0f : -1.0f) : 0.0f);
        out.f32(1);
    }
    out.zeros(8 + 12 + 16);
    for (const int detail : {0, 1, 0})
        for (const int number : {detail, 0, 8, 8, 1, 0, 0, 9, 6}) out.i32(number);
    out.zeros(20);
    for (const int next : {1, 0}) {
        for (const float number : {0.0f, 3.0f + static_cast<float>(next), 0.0f, 2.5f}) out.f32(number);
        for (const int number : {next, 1, 0, next == 0 ? 3 : 0}) out.i32(number);
        if (next == 0) out.zeros(16 + 8);
    }
    for (const int number : {-1, -1, 0, 0, 2, 0, 0}) out.i32(number);
    for (const int number : {1, -1, 0, 2, 1, 0, 0}) out.i32(number);
    out.zeros(20);
    for (const float number : {1.0f, 2.0f, 3.0f, 0.5f}) out.f32(number);
    out.zeros(28 + 40 + 88);
    for (const float number : {4.0f, 5.0f, 6.0f, 0.25f}) out.f32(number);
    out.zeros(24);
    for (int i = 0; i < 8; ++i) out.i32(i);
    out.i32(0);
    for (int i = 0; i < 6; ++i) out.i32(i);
    return out.all();
}

TEST(NeverballFile, IsRead) {
    const auto level = scenes::neverball_level("small", small_level());
    ASSERT_TRUE(level) << level.problem().message;
    EXPECT_EQ(level->points.size(), 8u);
    EXPECT_EQ(level->points[6], Vec3(-1, 1, 1));
    ASSERT_EQ(level->brushes.size(), 3u);
    EXPECT_TRUE(level->brushes[1].detail);
    EXPECT_EQ(level->brushes[2].points.size(), 8u);
    EXPECT_EQ(level->brushes[2].sides.back(), 5u);
    EXPECT_EQ(level->edges[level->brushes[0].edges[0]], glm::uvec2(0, 1));
    EXPECT_EQ(level->sides[1].normal, Vec3(-1, 0, 0));
    ASSERT_EQ(level->bodies.size(), 2u);
    EXPECT_FALSE(level->bodies[0].stop);
    EXPECT_EQ(*level->bodies[1].stop, 1u);
    EXPECT_EQ(level->stops[1].position, Vec3(0, 3, 0));
    EXPECT_EQ(level->stops[1].seconds, 2.5f);
    EXPECT_EQ(level->stops[0].next, 1u);
    EXPECT_TRUE(level->stops[0].moves);
    EXPECT_EQ(level->goals[0].position, Vec3(1, 2, 3));
    EXPECT_EQ(level->balls[0].radius, 0.25f);

    // The ray hits the static cube and the lift 3 higher; the detail is not solid.
    const auto solid = scenes::compound(*level);
    ASSERT_TRUE(solid);
    EXPECT_EQ(solid->size(), 2u);
    EXPECT_EQ(solid->bounds().max, Vec3(1, 4, 1));
    World3 world;
    scenes::add_to(world, *level);
    ASSERT_EQ(world.size(), 2u);
    EXPECT_EQ(world.user(world.containing({0.5f, 3.5f, 0.5f}).at(0)), 1u);
}

TEST(NeverballFile, CutOffAnywhereIsNamed) {
    const std::vector<char> whole = small_level();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto level = scenes::neverball_level("small", {whole.begin(), whole.begin() + static_cast<long>(size)});
        ASSERT_FALSE(level) << size;
        EXPECT_EQ(level.problem().code, ProblemCode::bad_format) << size;
        EXPECT_TRUE(level.problem().message.starts_with("small: ")) << level.problem().message;
    }
}

/// Replaces four bytes at every offset by numbers that are too large, negative, infinite or NaN.
TEST(NeverballFile, SpoiledIsNamedOrRead) {
    const std::vector<char> whole = small_level();
    int named = 0, tried = 0;
    for (std::size_t at = 0; at + 4 <= whole.size(); ++at)
        for (const std::uint32_t number : {0x7fffffffu, 0xffffffffu, 0x80000000u, 0x7f800000u, 0x7fc00000u, 1000u}) {
            std::vector<char> spoiled = whole;
            std::memcpy(spoiled.data() + at, &number, 4);
            const auto level = scenes::neverball_level("small", spoiled);
            ++tried;
            if (level) {
                const auto solid = scenes::compound(*level);
                EXPECT_TRUE(!solid || solid->size() <= level->brushes.size() * level->bodies.size());
            } else {
                ++named;
                EXPECT_TRUE(level.problem().message.starts_with("small: "));
                EXPECT_LE(level.problem().index, whole.size());
            }
        }
    EXPECT_GT(named, tried / 4);
}

TEST(NeverballFile, SaysWhatItIsnt) {
    std::vector<char> other = small_level();
    other[4] = 7;
    EXPECT_EQ(scenes::neverball_level("x", other).problem().message, "x: a level of Neverball, but not of version 8");
    other[0] = 0;
    EXPECT_EQ(scenes::neverball_level("x", other).problem().message, "x: not a level of Neverball");
    EXPECT_EQ(scenes::read_neverball("/nowhere/x.sol").problem().code, ProblemCode::not_found);
}

/// The maximal distance of a brush's points outside of its sides.
double off_sides(const scenes::NeverballLevel& level, const scenes::NeverballBrush& brush) {
    double result = 0;
    for (const std::uint32_t i : brush.points)
        for (const std::uint32_t k : brush.sides) {
            const scenes::NeverballHalfSpace& side = level.sides[k];
            const double height = dot(DVec<3>(side.normal), DVec<3>(level.points[i]));
            result = std::max(result, height - static_cast<double>(side.offset));
        }
    return result;
}

TEST(NeverballFile, AllLevelsOfThePackage) {
    const std::vector<std::string> files = neverball_files();
    if (files.empty()) GTEST_SKIP() << no_neverball;
    std::size_t brushes = 0, details = 0, rough = 0, paths = 0;
    double worst = 0;
    for (const std::string& file : files) {
        const auto level = scenes::read_neverball(file);
        ASSERT_TRUE(level) << level.problem().message;
        std::size_t of_bodies = 0;
        for (const scenes::NeverballBody& body : level->bodies) {
            of_bodies += body.brushes;
            paths += body.stop ? 1 : 0;
        }
        EXPECT_EQ(of_bodies, level->brushes.size()) << file;
        EXPECT_FALSE(level->balls.empty()) << file;
        brushes += level->brushes.size();
        for (const scenes::NeverballBrush& brush : level->brushes) {
            const double off = off_sides(*level, brush);
            rough += off > 3e-4 ? 1 : 0;
            details += brush.detail ? 1 : 0;
            worst = std::max(worst, off);
        }
        if (file.ends_with("map-fwp/rings.sol")) {
            EXPECT_EQ(level->brushes.size(), 3647u);
            EXPECT_EQ(level->points.size(), 12102u);
        }
    }
    EXPECT_EQ(files.size(), 183u);
    std::cout << files.size() << " levels: " << brushes << " brushes, " << details << " of them details, " << paths
              << " bodies on paths; of " << rough << " brushes points stand out by more than 3e-4, at most by " << worst
              << '\n';
    // The files are rounded, which affects the corners of nearly parallel planes.
    EXPECT_LT(worst, 4e-3);
    EXPECT_LT(rough * 300, brushes);
}

/// Two adjacent rooms with a step between them.
std::vector<char> small_wad() {
    Bytes things, lines, sides, points, sectors;
    for (const int kind : {3004, 1})
        for (const int number : {64 * kind % 1000, -64, 90, kind, 7}) things.u16(number);
    for (const auto& [x, y] : {std::pair(0, 0), {0, 128}, {128, 128}, {256, 128}, {256, 0}, {128, 0}})
        points.u16(x), points.u16(y);
    const auto line = [&](int from, int to, int flags, int does, int right, int left) {
        for (const int number : {from, to, flags, does, 0, right, left}) lines.u16(number);
    };
    for (int i = 0; i < 6; ++i) line(i, (i + 1) % 6, 1, 0, i == 2 || i == 3 || i == 4 ? 1 : 0, 0xffff);
    line(2, 5, 4, 0, 0, 1);      // a step up to the left, from the first room to the second
    line(5, 2, 4, 0, 1, 0);      // a step in the opposite direction
    line(2, 5, 4 + 1, 0, 0, 1);  // an impassable step
    line(2, 5, 4, 1, 0, 1);      // a door
    line(2, 5, 4, 0, 0, 2);      // a passage of low height
    for (const int sector : {0, 1, 2}) {
        sides.zeros(28);
        sides.u16(sector);
    }
    for (const auto& [floor, ceiling] : {std::pair(0, 128), {32, 160}, {0, 40}}) {
        sectors.u16(floor), sectors.u16(ceiling);
        sectors.zeros(22);
    }
    Bytes out, directory;
    out.text("PWAD", 4);
    const std::array<std::pair<const char*, const Bytes*>, 6> all{{{"E1M1", nullptr},
                                                                   {"THINGS", &things},
                                                                   {"LINEDEFS", &lines},
                                                                   {"SIDEDEFS", &sides},
                                                                   {"VERTEXES", &points},
                                                                   {"SECTORS", &sectors}}};
    out.i32(all.size());
    std::size_t at = 12;
    for (const auto& [name, bytes] : all) {
        const std::size_t size = bytes == nullptr ? 0 : bytes->size();
        directory.i32(static_cast<std::int64_t>(at)), directory.i32(static_cast<std::int64_t>(size));
        directory.text(name, 8);
        at += size;
    }
    out.i32(static_cast<std::int64_t>(at));
    for (const auto& [name, bytes] : all)
        if (bytes != nullptr) out.text({bytes->all().data(), bytes->size()}, bytes->size());
    out.text({directory.all().data(), directory.size()}, directory.size());
    return out.all();
}

TEST(WadFile, IsRead) {
    const auto maps = scenes::wad_maps("small", small_wad());
    ASSERT_TRUE(maps) << maps.problem().message;
    ASSERT_EQ(maps->size(), 1u);
    const scenes::WadMap& map = maps->front();
    EXPECT_EQ(map.name, "E1M1");
    EXPECT_EQ(map.lines.size(), 11u);
    EXPECT_EQ(map.one_sided.size(), 6u);
    EXPECT_EQ(map.points[3], Vec2(256, 128));
    EXPECT_EQ(*map.start, Vec2(64, -64));
    // The low room is to the right of both.
    const glm::uvec2 step(2, 5);
    EXPECT_EQ(map.ledges, (std::vector<glm::uvec2>{step, step}));
    EXPECT_EQ(map.barriers, (std::vector<glm::uvec2>{step, step}));
}

TEST(WadFile, CutOffAnywhereIsNamed) {
    const std::vector<char> whole = small_wad();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto maps = scenes::wad_maps("small", {whole.begin(), whole.begin() + static_cast<long>(size)});
        ASSERT_FALSE(maps) << size;
        EXPECT_TRUE(maps.problem().message.starts_with("small: ")) << maps.problem().message;
    }
}

TEST(WadFile, SpoiledIsNamedOrRead) {
    const std::vector<char> whole = small_wad();
    int named = 0;
    for (std::size_t at = 0; at + 2 <= whole.size(); ++at)
        for (const std::uint16_t number : std::initializer_list<std::uint16_t>{0x7fff, 0xffff, 0x8000, 1000}) {
            std::vector<char> spoiled = whole;
            std::memcpy(spoiled.data() + at, &number, 2);
            const auto maps = scenes::wad_maps("small", spoiled);
            named += maps ? 0 : 1;
            if (!maps) continue;
            for (const scenes::WadMap& map : *maps)
                for (const glm::uvec2& line : map.lines) EXPECT_LT(std::max(line.x, line.y), map.points.size());
        }
    EXPECT_GT(named, 100);
}

}  // namespace
}  // namespace abut::test
