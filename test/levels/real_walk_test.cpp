// A Mover on levels of real games: along paths of a search over squares, and at random on all levels. The oracle checks
// every frame against every piece.

#include "../oracle/is_long.hpp"
#include "../oracle/random.hpp"
#include "plane_walk.hpp"
#include "space_walk.hpp"

#include <iostream>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr std::uint64_t seed = 20260923;

constexpr const char* only_long = "only where ABUT_LONG is set";

void print_counts(const std::string& name, const Walked& walked) {
    std::cout << name << ": " << walked.frames << " frames, " << walked.touching << " of them touching, "
              << walked.grounded << " on ground, " << walked.crushed << " crushed, " << walked.rests
              << " rests; a path of " << walked.path_length << " sizes, deepest " << walked.deepest
              << " of the margin, restless by " << walked.restless << " of the size\n";
}

/// A mover in a view from above, without gravity.
MoverOptions<2> from_above() {
    return {.up = {0, 0}, .step_height = 0, .stick = 0};
}
Walking<2> player() {
    return {{{0, 0}, {0, 0}, player_radius}};
}

std::vector<scenes::WadMap> freedoom_maps() {
    std::vector<scenes::WadMap> result;
    for (const std::string& file : freedoom_files()) {
        const auto maps = scenes::read_wad(file);
        EXPECT_TRUE(maps) << maps.problem().message;
        if (maps) result.insert(result.end(), maps->begin(), maps->end());
    }
    return result;
}

/// Moves towards the next position until it is within a distance; false if it doesn't arrive.
bool go_to(Walker<2>& walker, const Vec2& place, float speed, double near) {
    for (int i = 0; i < 100; ++i) {
        const DVec<2> left = DVec<2>(place) - DVec<2>(walker.position());
        const double distance = length(left);
        if (distance < near) return true;
        walker.go(to_float(left * std::min(1.0, static_cast<double>(speed) / distance)));
    }
    return false;
}

TEST(RealWalk, ThroughMapsOfFreedoom) {
    if (!oracle::is_long()) GTEST_SKIP() << only_long;
    const std::vector<scenes::WadMap> maps = freedoom_maps();
    if (maps.empty()) GTEST_SKIP() << no_freedoom;
    Walked walked;
    std::size_t places = 0;
    int crossed = 0;
    for (const scenes::WadMap& map : maps) {
        ASSERT_TRUE(map.start) << map.name;
        const PlaneLevel level(map, map.name == "E1M1");
        const PlaneGrid grid(level, 16, player_radius + 1, *map.start);
        const std::vector<Vec2> path = grid.path_to_the_end();
        // The only exit of some starts is a lift.
        crossed += path.size() >= 10 ? 1 : 0;
        Walker<2> walker(level.world(), level.pieces(), player(), from_above(), *map.start, walked);
        for (const Vec2& place : path) {
            ASSERT_TRUE(go_to(walker, place, 10, 1)) << map.name << ' ' << text_of<2>(place);
            ++places;
        }
        ASSERT_EQ(walked.faults, 0) << map.name << ": " << walked.first_fault;
        if (map.name == "E1M1")
            std::cout << "E1M1: " << path.size() << " places, " << grid.reached() << " squares in reach\n";
    }
    print_counts("along " + std::to_string(places) + " places", walked);
    EXPECT_EQ(maps.size(), 68u);
    EXPECT_GT(crossed, 60);
}

TEST(RealWalk, AtRandomOverAllMapsOfFreedoom) {
    if (!oracle::is_long()) GTEST_SKIP() << only_long;
    const std::vector<scenes::WadMap> maps = freedoom_maps();
    if (maps.empty()) GTEST_SKIP() << no_freedoom;
    oracle::Random random(seed);
    Walked walked;
    for (std::size_t number = 0; number < maps.size(); ++number) {
        const scenes::WadMap& map = maps[number];
        const PlaneLevel level(map, number % 2 == 1);
        // The region for a mover of radius 0, which contains the region of every larger one.
        const PlaneGrid grid(level, 16, 0, *map.start);
        Walker<2> walker(level.world(), level.pieces(), player(), from_above(), *map.start, walked);
        DVec<2> velocity(0.0);
        for (int frame = 0; frame < 5000; ++frame) {
            if (frame % 25 == 0)
                velocity =
                    random.direction<2>() * (random.chance(0.1) ? random.uniform(0, 200) : random.uniform(0, 14));
            walker.go(to_float(velocity));
            if (!grid.holds(walker.position()))
                walked.fault("is beyond a wall at " + text_of<2>(walker.position()) + " going " +
                             text_of<2>(to_float(velocity)));
            ASSERT_EQ(walked.faults, 0) << map.name << " frame " << frame << ": " << walked.first_fault;
        }
    }
    print_counts("at random", walked);
    EXPECT_GT(walked.touching, walked.frames / 4);
}

MoverOptions<3> over_ground(const scenes::NeverballBall& ball) {
    return {.step_height = 0.5f * ball.radius, .stick = 0.5f * ball.radius};
}

/// Moves under gravity until above a position.
bool roll_to(Walker<3>& walker, const Vec3& place, float speed, double near, float& fall) {
    for (int i = 0; i < 100; ++i) {
        DVec<3> left = DVec<3>(place) - DVec<3>(walker.position());
        left[1] = 0;
        const double distance = length(left);
        if (distance < near) return true;
        fall = walker.moved().grounded ? 0.01f : std::min(fall + 0.005f, 0.2f);
        Vec3 motion = to_float(left * std::min(1.0, static_cast<double>(speed) / distance));
        motion.y = -fall;
        walker.go(motion);
    }
    return false;
}

/// Tests a ball, and a capsule with the same lowest point.
std::vector<Walking<3>> rolling(float radius) {
    return {{{{0, 0, 0}, {0, 0, 0}, radius}}, {{{0, 0, 0}, {0, radius, 0}, radius}}};
}

TEST(RealWalk, FromTheBallToTheGoalInNeverball) {
    if (!oracle::is_long()) GTEST_SKIP() << only_long;
    const std::vector<std::string> files = neverball_files();
    if (files.empty()) GTEST_SKIP() << no_neverball;
    Walked walked;
    int levels_walked = 0, arrived = 0;
    std::size_t places = 0;
    for (const std::string& file : files) {
        const auto read = scenes::read_neverball(file);
        ASSERT_TRUE(read) << read.problem().message;
        const SpaceLevel level(*read, levels_walked % 2 == 1);
        const scenes::NeverballBall ball = read->balls[0];
        if (read->goals.empty() || ball.radius <= 0) continue;
        const SpaceGrid grid(level, ball, read->goals[0]);
        if (grid.path().empty()) continue;
        ++levels_walked;
        bool all = true;
        for (const Walking<3>& shape : rolling(ball.radius)) {
            Walker<3> walker(level.world(), level.pieces(), shape, over_ground(ball), ball.position, walked);
            float fall = 0;
            std::size_t number = 0;
            for (const Vec3& place : grid.path()) {
                if (!roll_to(walker, place, 0.25f * ball.radius, 0.05 * static_cast<double>(ball.radius), fall)) {
                    std::cout << file << ": stuck at " << number << " of " << grid.path().size() << ", "
                              << text_of<3>(walker.position()) << " before " << text_of<3>(place) << '\n';
                    all = false;
                    break;
                }
                if (++number % 40 == 0) walker.rest({0, -0.01f, 0});
                ++places;
            }
            ASSERT_EQ(walked.faults, 0) << file << ": " << walked.first_fault;
        }
        arrived += all ? 1 : 0;
    }
    print_counts(std::to_string(arrived) + " of " + std::to_string(levels_walked) + " levels along " +
                     std::to_string(places) + " places",
                 walked);
    EXPECT_GT(levels_walked, 20);
}

TEST(RealWalk, AtRandomOverAllLevelsOfNeverball) {
    if (!oracle::is_long()) GTEST_SKIP() << only_long;
    const std::vector<std::string> files = neverball_files();
    if (files.empty()) GTEST_SKIP() << no_neverball;
    oracle::Random random(seed);
    Walked walked;
    for (std::size_t number = 0; number < files.size(); ++number) {
        const auto read = scenes::read_neverball(files[number]);
        ASSERT_TRUE(read) << read.problem().message;
        const SpaceLevel level(*read, number % 2 == 1);
        const scenes::NeverballBall ball = read->balls[0];
        const float radius = ball.radius > 0 ? ball.radius : 0.25f;
        const Aabb3 all = level.pieces().bounds();
        for (const Walking<3>& shape : rolling(radius)) {
            Walker<3> walker(level.world(), level.pieces(), shape, over_ground({{}, radius}), ball.position, walked);
            DVec<3> velocity(0.0);
            double fall = 0;
            for (int frame = 0; frame < 800; ++frame) {
                if (frame % 25 == 0) {
                    velocity =
                        random.direction<3>() * (random.chance(0.1) ? random.uniform(0, 1) : random.uniform(0, 0.1));
                    velocity[1] = random.chance(0.2) ? std::abs(velocity[1]) : 0;
                }
                // A mover that falls off starts again above the level.
                if (walker.position().y < all.min.y - 2)
                    walker.put(all.min + (all.max - all.min) *
                                             Vec3(random.uniform_float(0, 1), 1.1f, random.uniform_float(0, 1)));
                fall = walker.moved().grounded ? 0.01 : std::min(fall + 0.01, 1.0);
                DVec<3> motion = velocity;
                if (!(motion[1] > 0)) motion[1] = -fall;
                walker.go(to_float(motion));
                if (frame % 200 == 199) walker.rest({0, -0.01f, 0});
                ASSERT_EQ(walked.faults, 0) << files[number] << " frame " << frame << ": " << walked.first_fault;
            }
        }
    }
    print_counts("at random", walked);
    EXPECT_GT(walked.touching, walked.frames / 4);
}

}  // namespace
}  // namespace abut::test
