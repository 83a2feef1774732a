// A Mover on generated levels of every kind of shape, checked frame by frame against each part by the oracle, without
// the library.

#include "../oracle/is_long.hpp"
#include "../oracle/random.hpp"
#include "levels.hpp"
#include "walks.hpp"

#include <iostream>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

constexpr std::uint64_t seed = 20260927;

/// All parts of the level as polytopes for the oracle.
template <int D>
Pieces<D> pieces_of(const Level<D>& level) {
    Pieces<D> result;
    for (const LevelPart<D>& part : level.parts) {
        const auto& convex = std::get<Convex<D>>(part.view);
        std::vector<Vec<D>> corners;
        const std::uint32_t count = convex.core == Core::box ? 1u << D : convex.count;
        EXPECT_TRUE(convex.core == Core::box || convex.core == Core::points);
        for (std::uint32_t i = 0; i < count; ++i)
            corners.push_back(to_float(convex.place.point(local_corner(convex, i))));
        result.add(oracle::hull_of<D>(corners));
    }
    result.build();
    return result;
}

template <int D>
Vec<D> unit_of(int axis) {
    Vec<D> result(0.0f);
    result[axis] = 1;
    return result;
}

/// Walks to and fro over the level with occasional jumps. The walk starts above the level, and again after a fall.
template <int D>
void walk_over(const char* name, const Level<D>& level, int up, int frames) {
    World<D> world;
    world.add(level.shape, {.fixed = true});
    const Pieces<D> pieces = pieces_of(level);
    const Aabb<D> all = pieces.bounds();
    Walking<D> hero;
    hero.shape = {unit_of<D>(up) * -0.2f, unit_of<D>(up) * 0.2f, 0.25f};
    oracle::Random random(seed);
    Walked walked;
    MoverOptions<D> options;
    options.up = unit_of<D>(up);
    const auto above = [&] {
        Vec<D> result = center(all) + 0.3f * (all.max - all.min) * to_float(random.in_cube<D>());
        result[up] = all.max[up] + 1;
        return result;
    };
    Walker<D> walker(world, pieces, hero, options, above(), walked);
    DVec<D> velocity(0.0);
    float fall = 0;
    for (int frame = 0; frame < frames; ++frame) {
        if (frame % 40 == 0) {
            velocity = random.direction<D>() * random.uniform(0.01, random.chance(0.1) ? 1 : 0.12);
            velocity[up] = 0;
        }
        if (walker.position()[up] < all.min[up] - 2) walker.put(above());
        if (walker.moved().grounded) fall = random.chance(0.02) ? -0.15f : 0.01f;
        fall = std::min(fall + 0.008f, 0.4f);
        Vec<D> motion = to_float(velocity);
        motion[up] = -fall;
        walker.go(motion);
        if (frame % 150 == 149) walker.rest(unit_of<D>(up) * -0.01f);
        ASSERT_EQ(walked.faults, 0) << name << " frame " << frame << ": " << walked.first_fault;
    }
    std::cout << name << ": " << walked.frames << " frames, " << walked.grounded << " on ground, " << walked.rests
              << " rests, a path of " << walked.path_length << " sizes\n";
    EXPECT_GT(walked.grounded, frames / 3) << name;
    EXPECT_GT(walked.rests, 0) << name;
    EXPECT_GT(walked.path_length, frames / 20) << name;
    EXPECT_EQ(walked.crushed, 0) << name;
}

int frames() {
    return oracle::is_long() ? 20000 : 1200;
}

TEST(GeneratedWalk, OverAChain) {
    oracle::Random random(seed);
    std::vector<Vec2> points;
    for (int i = 0; i < 120; ++i)
        points.emplace_back(30 - 0.5f * static_cast<float>(i), random.uniform_float(-0.4, 0.4));
    walk_over<2>("chain", level_of(*Chain::build(points, false)), 1, frames());
}

TEST(GeneratedWalk, OverTiles) {
    oracle::Random random(seed);
    constexpr std::uint32_t columns = 40;
    const std::array<Tile, 3> kinds{Tile::full, Tile::slope_high_x_low_y, Tile::slope_low_x_low_y};
    std::vector<Tile> tiles(columns * 8, Tile::empty);
    for (std::uint32_t x = 0; x < columns; ++x) {
        tiles[x] = Tile::full;
        if (random.chance(0.3)) tiles[columns + x] = kinds[random.below(3)];
        if (random.chance(0.2)) tiles[4 * columns + x] = Tile::full;
    }
    walk_over<2>("tiles", level_of(*TileMap::build(tiles, columns, 1.0f)), 1, frames());
}

TEST(GeneratedWalk, OverAHeightField) {
    oracle::Random random(seed);
    std::vector<float> heights;
    for (int i = 0; i < 30 * 30; ++i) heights.push_back(random.uniform_float(-0.3, 0.3));
    const std::vector<std::uint32_t> holes{100, 101, 350, 600};
    walk_over<3>("height field", level_of(*HeightField::build(heights, 30, 0.7f, {.holes = holes})), 2, frames());
}

TEST(GeneratedWalk, OverAMesh) {
    oracle::Random random(seed);
    walk_over<3>("mesh", level_of(random_terrain(random, 24, 1).surface().mesh()), 2, frames());
}

TEST(GeneratedWalk, OverACompound) {
    oracle::Random random(seed);
    std::vector<AnyShape<3>> children{Box3{{0, 0, -0.5f}, {12, 12, 0.5f}}};
    for (int i = 0; i < 60; ++i) {
        Box3 box{to_float(random.in_cube<3>() * 11.0), {}};
        box.center.z = random.uniform_float(-0.3, 1.5);
        for (int axis = 0; axis < 3; ++axis) box.half[axis] = random.uniform_float(0.1, 1);
        if (random.chance(0.5)) box.rotation = random.rotation<3>();
        children.push_back(box);
    }
    Level<3> level{*Compound3::build(children), {}};
    for (std::uint32_t i = 0; i < children.size(); ++i) level.parts.push_back({children[i].view(), i});
    walk_over<3>("compound", level, 2, frames());
}

}  // namespace
}  // namespace abut::test
