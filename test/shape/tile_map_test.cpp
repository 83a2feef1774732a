#include "../oracle/expect.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/tile_map.hpp>

#include <limits>
#include <vector>

namespace abut {
namespace {

using oracle::near;

TileMap one_tile(Tile tile) {
    return *TileMap::build(std::vector<Tile>{tile}, 1, 2.0f);
}

TEST(TileMap, TellsWhatIsWrongAndWhere) {
    const auto problem = [](const std::vector<Tile>& tiles, std::uint32_t columns, Vec2 cell) {
        const Result<TileMap> built = TileMap::build(tiles, columns, cell);
        EXPECT_FALSE(built);
        return built ? Problem{} : built.problem();
    };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::vector<Tile> six(6, Tile::full);
    EXPECT_EQ(problem({}, 1, Vec2(1)).code, ProblemCode::empty_input);
    EXPECT_EQ(problem(six, 0, Vec2(1)).code, ProblemCode::bad_argument);
    EXPECT_EQ(problem(six, 4, Vec2(1)).code, ProblemCode::bad_argument);
    for (const Vec2 cell : {Vec2(0, 1), Vec2(1, -1), Vec2(1, infinity), Vec2(3e38f, 1)})
        EXPECT_EQ(problem(six, 3, cell).code, ProblemCode::bad_argument);
    std::vector<Tile> unknown = six;
    unknown[4] = static_cast<Tile>(14);
    EXPECT_EQ(problem(unknown, 3, Vec2(1)).index, 4u);
}

TEST(TileMap, OfEachKindHoldsWhatItsNameSays) {
    struct Row {
        Tile tile;
        bool low_x, high_x, low_y, high_y;  ///< near the middle of each side
    };
    for (const Row& row :
         {Row{Tile::empty, false, false, false, false}, Row{Tile::full, true, true, true, true},
          Row{Tile::half_low_x, true, false, false, false}, Row{Tile::half_high_x, false, true, false, false},
          Row{Tile::half_low_y, false, false, true, false}, Row{Tile::half_high_y, false, false, false, true},
          Row{Tile::slope_low_x_low_y, true, false, true, false},
          Row{Tile::slope_high_x_low_y, false, true, true, false},
          Row{Tile::slope_low_x_high_y, true, false, false, true},
          Row{Tile::slope_high_x_high_y, false, true, false, true},
          Row{Tile::one_way_low_x, false, false, false, false}}) {
        SCOPED_TRACE(static_cast<int>(row.tile));
        const TileMap map = one_tile(row.tile);
        EXPECT_EQ(contains(map, Vec2(0.2f, 1.0f)),
                  row.low_x || row.tile == Tile::half_low_y || row.tile == Tile::half_high_y);
        EXPECT_EQ(contains(map, Vec2(1.8f, 1.0f)),
                  row.high_x || row.tile == Tile::half_low_y || row.tile == Tile::half_high_y);
        EXPECT_EQ(contains(map, Vec2(1.0f, 0.2f)),
                  row.low_y || row.tile == Tile::half_low_x || row.tile == Tile::half_high_x);
        EXPECT_EQ(contains(map, Vec2(1.0f, 1.8f)),
                  row.high_y || row.tile == Tile::half_low_x || row.tile == Tile::half_high_x);
    }
}

TEST(TileMap, OneWayTilesAreHitFromOutside) {
    struct Row {
        Tile tile;
        Vec2 out;
    };
    for (const Row& row : {Row{Tile::one_way_low_x, {-1, 0}}, Row{Tile::one_way_high_x, {1, 0}},
                           Row{Tile::one_way_low_y, {0, -1}}, Row{Tile::one_way_high_y, {0, 1}}}) {
        SCOPED_TRACE(static_cast<int>(row.tile));
        const TileMap map = one_tile(row.tile);
        const Vec2 middle(1, 1), outside = middle + row.out * 3.0f;
        const Box2 box{outside, {0.25f, 0.25f}}, inside{middle, {0.25f, 0.25f}};
        const auto hit = sweep(box, row.out * -6.0f, map);
        ASSERT_TRUE(hit);
        EXPECT_FLOAT_EQ(hit->distance, 1.75f);
        EXPECT_TRUE(near(hit->normal, row.out));
        EXPECT_FALSE(sweep(inside, row.out * 6.0f, map));
        EXPECT_TRUE(raycast(Ray2::between(outside, middle), map));
        EXPECT_FALSE(raycast(Ray2::between(middle, outside), map));
        // A shape resting on it, slightly deep, is supported; one jumping up through it is free until it is mostly
        // past.
        const Box2 resting{middle + row.out * 1.24f, {0.25f, 0.25f}}, jumping{middle + row.out * 0.9f, {0.25f, 0.25f}};
        ASSERT_TRUE(contact(resting, map));
        EXPECT_TRUE(near(contact(resting, map).normal, -row.out));
        EXPECT_TRUE(sweep(resting, row.out * -1.0f, map));
        EXPECT_FALSE(sweep(resting, row.out, map));
        EXPECT_FALSE(contact(jumping, map));
        EXPECT_FALSE(sweep(jumping, row.out * -1.0f, map));
    }
}

TEST(TileMap, KnowsWhereItsTilesAre) {
    // Row by row from low y:  # .     . /     with cells 2 wide and 1 high.
    const TileMap map = *TileMap::build(
        std::vector<Tile>{Tile::full, Tile::empty, Tile::empty, Tile::slope_low_x_low_y}, 2, Vec2(2, 1));
    EXPECT_EQ(map.rows(), 2u);
    EXPECT_EQ(bounds(map), (Aabb2{{0, 0}, {4, 2}}));
    EXPECT_EQ(map.box(3), (Aabb2{{2, 1}, {4, 2}}));
    EXPECT_EQ(closest(map, Vec2(-1, 0.5f)).feature_a.part, 0u);
    const auto hit = raycast(Ray2::between({4, 1.5f}, {-4, 1.5f}), map);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->feature.part, 3u);
    EXPECT_FLOAT_EQ(hit->point.x, 3);
    EXPECT_EQ(map.neighbour(0, 0), no_neighbour);  // empty
    EXPECT_EQ(map.neighbour(0, 1), no_neighbour);  // outside
    EXPECT_EQ(map.neighbour(1, 1), 0u);
    EXPECT_EQ(map.neighbour(1, 2), 3u);
    EXPECT_EQ(map.neighbour(2, 3), 0u);
    const TileMap nothing = *TileMap::build(std::vector<Tile>(4, Tile::empty), 2, 1.0f);
    EXPECT_FALSE(overlaps(nothing, Circle{{1, 1}, 5}));
    EXPECT_EQ(closest(nothing, Vec2(1, 1)).distance, std::numeric_limits<float>::infinity());
}

}  // namespace
}  // namespace abut
