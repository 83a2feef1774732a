#include "tool/faults/gaps.hpp"

#include "../oracle/random.hpp"
#include "level_of.hpp"
#include "tool/faults/necks.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace abut::tool {

using namespace detail;

namespace {

using oracle::Random;

std::vector<Gap<2>> gaps_of(const test::PlaneLevel& level, double width) {
    return find_gaps(FacetTree<2>(level.view_of().objects), {width, 0.1 * width});
}

std::vector<Gap<3>> gaps_of(Scene scene, double width) {
    const test::SpaceLevel level(std::move(scene));
    return find_gaps(FacetTree<3>(level.view_of().objects), {width, 0.1 * width, DVec<3>(0, 1, 0)});
}

TEST(Gaps, BetweenTwoBoxesOfThePlane) {
    test::PlaneLevel level;
    level.add_box("a", {0, 0}, {1, 1});
    level.add_box("b", {1.5f, 0.25f}, {3, 4});
    const std::vector<Gap<2>> gaps = gaps_of(level, 0.8);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_EQ(gaps[0].a, 0u);
    EXPECT_EQ(gaps[0].b, 1u);
    EXPECT_FLOAT_EQ(gaps[0].width, 0.5f);
    EXPECT_NEAR(gaps[0].position.x, 1.25, 1e-5);
    EXPECT_NEAR(gaps[0].position.y, 0.625, 1e-4) << "in the middle of where they face one another";
    EXPECT_NEAR(gaps[0].on_a.x, 1, 1e-5);
    EXPECT_NEAR(gaps[0].on_b.x, 1.5, 1e-5);
    EXPECT_TRUE(gaps_of(level, 0.5).empty()) << "not narrower";
    EXPECT_TRUE(gaps_of(level, 6).empty()) << "a seam beside that width";
}

TEST(Gaps, ADoorInAWallOfLines) {
    test::PlaneLevel level;
    level.add_line("left", {{0, 0}, {4, 0}});
    level.add_line("right", {{4.6f, 0}, {9, 0}, {9, 5}});
    const std::vector<Gap<2>> gaps = gaps_of(level, 1);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_NEAR(gaps[0].width, 0.6, 1e-6);
}

TEST(Gaps, NoneInCornersCracksAndNiches) {
    test::PlaneLevel level;
    // A room with nothing but its corners; a corner of 30 degrees; a crack with a bottom, 0.3 wide.
    level.add_box("south", {0, -1}, {8, 0});
    level.add_box("west", {-1, 0}, {0, 5});
    level.add("slope", {{0, 5}, {8, 1}, {8, 5}});
    level.add_box("crack, left", {2, 0}, {3, 1});
    level.add_box("crack, right", {3.3f, 0}, {4, 1});
    EXPECT_TRUE(gaps_of(level, 0.9).empty());
    // Without a bottom it is a passage.
    test::PlaneLevel open;
    open.add_box("left", {2, 0}, {3, 1});
    open.add_box("right", {3.3f, 0}, {4, 1});
    EXPECT_EQ(gaps_of(open, 0.9).size(), 1u);
}

TEST(Gaps, APassageThatBendsIsOne) {
    // A ring of 24 corners within a ring-shaped wall, half of it: 0.5 between them.
    test::PlaneLevel level;
    const auto at = [](int i, double radius) {
        const double angle = 3.14159265358979 * i / 24;
        return Vec2(DVec<2>(radius * std::cos(angle), radius * std::sin(angle)));
    };
    for (int i = 0; i < 24; ++i) {
        level.add("inner " + std::to_string(i), {at(i, 2), at(i, 3), at(i + 1, 3), at(i + 1, 2)});
        level.add("outer " + std::to_string(i), {at(i, 3.5), at(i, 5), at(i + 1, 5), at(i + 1, 3.5)});
    }
    const std::vector<Gap<2>> gaps = gaps_of(level, 0.9);
    ASSERT_GE(gaps.size(), 1u);
    for (const Gap<2>& gap : gaps) EXPECT_NEAR(gap.width, 0.5, 0.02);
}

// Rooms with doors of known widths in the walls between them: exactly the narrower ones are reported.
struct Door {
    Vec2 middle{};
    float width = 0;
};

struct Maze {
    std::vector<std::pair<Vec2, Vec2>> walls;  // boxes, min and max
    std::vector<Door> doors;
};

Maze random_maze(Random& random, int rooms) {
    constexpr float room = 4, half = 0.15f;
    Maze maze;
    const auto add = [&](bool upright, float along_from, float along_to, float across) {
        const Vec2 min(along_from, across - half), max(along_to, across + half);
        maze.walls.push_back(upright ? std::pair(Vec2(min.y, min.x), Vec2(max.y, max.x)) : std::pair(min, max));
    };
    for (const bool upright : {false, true})
        for (int line = 0; line <= rooms; ++line)
            for (int i = 0; i < rooms; ++i) {
                const float across = room * static_cast<float>(line), from = room * static_cast<float>(i);
                if (line == 0 || line == rooms) {
                    add(upright, from - half, from + room + half, across);
                    continue;
                }
                const float width = random.uniform_float(0.15, 1.6);
                const float middle = from + random.uniform_float(1.2, 2.8);
                add(upright, from - half, middle - 0.5f * width, across);
                add(upright, middle + 0.5f * width, from + room + half, across);
                maze.doors.push_back({upright ? Vec2(across, middle) : Vec2(middle, across), width});
            }
    return maze;
}

template <int D>
void expect_doors(const Maze& maze, const std::vector<Gap<D>>& gaps, double width) {
    std::size_t narrow = 0;
    for (const Door& door : maze.doors) {
        if (std::abs(static_cast<double>(door.width) - width) < 1e-4) continue;
        const bool is_narrow = static_cast<double>(door.width) < width;
        narrow += is_narrow ? 1 : 0;
        const auto found = std::count_if(gaps.begin(), gaps.end(), [&](const Gap<D>& gap) {
            const Vec2 place =
                D == 2 ? Vec2(gap.position[0], gap.position[1]) : Vec2(gap.position[0], gap.position[D - 1]);
            return glm::distance(place, door.middle) < 0.01f && std::abs(gap.width - door.width) < 1e-4f;
        });
        EXPECT_EQ(found, is_narrow ? 1 : 0)
            << "door " << door.width << " wide at " << door.middle.x << ", " << door.middle.y;
    }
    EXPECT_EQ(gaps.size(), narrow);
    EXPECT_GT(narrow, maze.doors.size() / 5);
    EXPECT_LT(narrow, maze.doors.size() * 4 / 5);
}

TEST(Gaps, TheDoorsOfAMazeThatAreTooNarrow) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const Maze maze = random_maze(random, 8);
        test::PlaneLevel level;
        for (const auto& [min, max] : maze.walls)
            level.add_box("wall " + std::to_string(level.view_of().objects.size()), min, max);
        FacetTree<2> facets(level.view_of().objects);
        expect_doors(maze, find_gaps(facets, {0.8, 0.1}), 0.8);
    }
}

TEST(Gaps, TheSameMazeInSpace) {
    Random random(4);
    const Maze maze = random_maze(random, 4);
    Scene scene;
    for (const auto& [min, max] : maze.walls)
        test::add_box(scene, "wall " + std::to_string(scene.nodes.size()), {min.x, 0, min.y}, {max.x, 2.5, max.y});
    test::add_box(scene, "floor", {-1, -0.3, -1}, {17, 0, 17});
    const test::SpaceLevel level(std::move(scene));
    expect_doors(maze, find_gaps(FacetTree<3>(level.view_of().objects), {0.8, 0.1, DVec<3>(0, 1, 0)}), 0.8);
}

// The necks of convex obstacles are the closest pairs with nothing else in the ball between them: a reference over all
// pairs of polygons.
TEST(Gaps, NecksOfConvexObstaclesAreThoseOfAllPairs) {
    constexpr double width = 1, least = 0.1;
    std::size_t necks_in_all = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        test::PlaneLevel level;
        std::vector<Polygon> polygons;
        for (int i = 0; i < 30; ++i) {
            const Vec2 middle(random.uniform_float(0, 10), random.uniform_float(0, 10));
            std::vector<Vec2> points;
            for (int k = 0; k < 6; ++k) points.push_back(middle + Vec2(random.in_cube<2>()) * 0.7f);
            const Result<Polygon> polygon = Polygon::build(points);
            ASSERT_TRUE(polygon);
            const bool is_apart = std::all_of(polygons.begin(), polygons.end(), [&](const Polygon& other) {
                return closest(other, *polygon).distance > 0.02f;
            });
            if (!is_apart) continue;
            polygons.push_back(*polygon);
            level.add("p" + std::to_string(polygons.size()), {polygon->points().begin(), polygon->points().end()});
        }
        // An obstacle that reaches into the ball by a smaller share of the radius may or may not count.
        constexpr float tolerance = 0.004f;
        const std::vector<Neck<2>> necks = find_necks(FacetTree<2>(level.view_of().objects), {width, least});
        for (std::size_t i = 0; i < polygons.size(); ++i)
            for (std::size_t j = i + 1; j < polygons.size(); ++j) {
                const Closest<2> between = closest(polygons[i], polygons[j]);
                const Vec2 middle = (between.on_a + between.on_b) * 0.5f;
                float nearest = 100;
                for (std::size_t k = 0; k < polygons.size(); ++k)
                    if (k != i && k != j) nearest = std::min(nearest, closest(polygons[k], middle).distance);
                const float radius = 0.5f * between.distance;
                const bool fits =
                    static_cast<double>(between.distance)<width&& static_cast<double>(between.distance)> least;
                const auto found = std::count_if(necks.begin(), necks.end(), [&](const Neck<2>& neck) {
                    return std::min(neck.a, neck.b) == i && std::max(neck.a, neck.b) == j &&
                           std::abs(static_cast<float>(neck.width) - between.distance) < 1e-3f * between.distance;
                });
                if (fits && nearest > radius * (1 + tolerance)) {
                    EXPECT_GE(found, 1) << i << " and " << j << ", " << between.distance;
                    ++necks_in_all;
                }
                if (!fits || nearest < radius * (1 - tolerance)) {
                    EXPECT_EQ(found, 0) << i << " and " << j << ", " << between.distance;
                }
            }
    }
    EXPECT_GT(necks_in_all, 400u);
}

// The path between two places with the largest clearance, on a fine grid, is narrowest at a neck, and its clearance is
// half of the neck's width. Polygons may overlap here.
TEST(Gaps, TheWidestPathsOfAGridGoThroughNecks) {
    constexpr double step = 0.04, width = 1.2;
    constexpr int cells = 200;
    std::size_t narrow = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        test::PlaneLevel level;
        for (int i = 0; i < 22; ++i) {
            const Vec2 middle(random.uniform_float(0, 8), random.uniform_float(0, 8));
            std::vector<Vec2> points;
            for (int k = 0; k < 6; ++k) points.push_back(middle + Vec2(random.in_cube<2>()) * 0.9f);
            const Result<Polygon> polygon = Polygon::build(points);
            ASSERT_TRUE(polygon);
            level.add("p" + std::to_string(i), {polygon->points().begin(), polygon->points().end()});
        }
        const auto& objects = level.view_of().objects;
        std::vector<double> clearance;
        const auto place = [&](int cell) { return Vec2(DVec<2>(cell % cells + 0.5, cell / cells + 0.5) * step); };
        for (int cell = 0; cell < cells * cells; ++cell) {
            float least = 10;
            for (const ViewedObject<2>& object : objects)
                least = std::min(least, closest(object.shape, place(cell)).distance);
            clearance.push_back(static_cast<double>(least));
        }
        const std::vector<Neck<2>> necks = find_necks(FacetTree<2>(objects), {width, 0.0});
        // Areas grow from the places of largest clearance: where two of them join there is a neck.
        std::vector<int> order(clearance.size()), area(clearance.size(), -1);
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
        std::sort(order.begin(), order.end(), [&](int a, int b) {
            const double x = clearance[static_cast<std::size_t>(a)], y = clearance[static_cast<std::size_t>(b)];
            return x > y || (x == y && a < b);
        });
        const auto root = [&](int cell) {
            while (area[static_cast<std::size_t>(cell)] != cell) cell = area[static_cast<std::size_t>(cell)];
            return cell;
        };
        for (const int cell : order) {
            const double here = clearance[static_cast<std::size_t>(cell)];
            if (here < 0.15) break;
            area[static_cast<std::size_t>(cell)] = cell;
            for (const int dy : {-1, 0, 1})
                for (const int dx : {-1, 0, 1}) {
                    const int x = cell % cells + dx, y = cell / cells + dy;
                    if (x < 0 || y < 0 || x >= cells || y >= cells) continue;
                    const int other = y * cells + x;
                    if (area[static_cast<std::size_t>(other)] < 0) continue;
                    const int a = root(cell), b = root(other);
                    if (a == b) continue;
                    // The first place of the wider one represents both.
                    const double wide_a = clearance[static_cast<std::size_t>(a)],
                                 wide_b = clearance[static_cast<std::size_t>(b)];
                    area[static_cast<std::size_t>(wide_a >= wide_b ? b : a)] = wide_a >= wide_b ? a : b;
                    // Both are wider than the place where they join, by more than the grid's steps.
                    if (std::min(wide_a, wide_b) < here + 3 * step || 2 * (here + step) > width) continue;
                    const bool at_border = x < 2 || y < 2 || x >= cells - 2 || y >= cells - 2;
                    if (at_border) continue;
                    ++narrow;
                    const bool is_neck = std::any_of(necks.begin(), necks.end(), [&](const Neck<2>& neck) {
                        return length(neck.middle - DVec<2>(place(cell))) < 10 * step &&
                               std::abs(0.5 * neck.width - here) < 1.5 * step;
                    });
                    EXPECT_TRUE(is_neck) << "at " << place(cell).x << ", " << place(cell).y << " half " << here;
                }
        }
    }
    EXPECT_GT(narrow, 15u);
}

TEST(Gaps, CratesOnAFloorAndAgainstAWall) {
    Scene scene;
    test::add_box(scene, "a", {0, 0, 0}, {1, 1, 1});
    test::add_box(scene, "b", {1.4, 0, 0}, {2.4, 1, 1});
    test::add_box(scene, "floor", {-5, -1, -5}, {5, 0, 5});
    const std::vector<Gap<3>> gaps = gaps_of(scene, 0.8);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_NEAR(gaps[0].width, 0.4, 1e-5);
    EXPECT_NEAR(gaps[0].position.x, 1.2, 1e-5);

    // With a wall behind them there is no path through, though they are open from above and in front.
    test::add_box(scene, "wall", {-5, 0, 1}, {5, 2, 2});
    EXPECT_TRUE(gaps_of(scene, 0.8).empty());
}

TEST(Gaps, AWindowInOneMesh) {
    // A frame around an opening of 0.5 by 0.75 in a wall of 0.25; the ring of its front as eight triangles.
    const auto frame = [](float width) {
        const float x = 0.5f * width;
        const std::vector<Vec2> ring{{-2, -1}, {2, -1}, {2, 2}, {-2, 2}, {-x, 0}, {x, 0}, {x, 0.75f}, {-x, 0.75f}};
        test::Triangles result;
        for (const float z : {0.0f, 0.25f})
            for (const Vec2& p : ring) result.points.emplace_back(p.x, p.y, z);
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t next = (i + 1) % 4, in = 4 + i, in_next = 4 + next;
            result.triangles.insert(result.triangles.end(), {{8 + i, 8 + next, 8 + in_next},
                                                             {8 + i, 8 + in_next, 8 + in},
                                                             {i, in_next, next},
                                                             {i, in, in_next},
                                                             {i, next, 8 + next},
                                                             {i, 8 + next, 8 + i},
                                                             {in, 8 + in_next, in_next},
                                                             {in, 8 + in, 8 + in_next}});
        }
        return result;
    };
    Scene scene;
    test::add_object(scene, "Wall", frame(0.5f));
    const std::vector<Gap<3>> gaps = gaps_of(scene, 0.8);
    ASSERT_EQ(gaps.size(), 1u) << "one for the window, across which it is narrower";
    EXPECT_EQ(gaps[0].a, gaps[0].b);
    EXPECT_NEAR(gaps[0].width, 0.5, 1e-5);
    EXPECT_NEAR(glm::distance(gaps[0].position, Vec3(0, 0.375f, 0.125f)), 0, 1e-4);

    Scene wider;
    test::add_object(wider, "Wall", frame(0.7f));
    EXPECT_EQ(gaps_of(wider, 0.72).size(), 1u);
    EXPECT_TRUE(gaps_of(wider, 0.69).empty());
}

TEST(Gaps, NoneOnStairsAndInRooms) {
    Scene scene;
    for (int i = 0; i < 6; ++i)
        test::add_box(scene, "step " + std::to_string(i), {0.3 * i, 0, 0}, {0.3 * (i + 1), 0.2 * (i + 1), 2});
    test::add_object(scene, "room", test::inside_out(test::box_triangles({9, 9, 9})));
    EXPECT_TRUE(gaps_of(scene, 0.8).empty());
}

TEST(Gaps, WhatIsUnderTheGroundIsNoPassage) {
    // Two posts as deep below an open ground as they are high.
    Scene scene;
    test::add_box(scene, "a", {0, -2, 0}, {0.2, 2, 0.2});
    test::add_box(scene, "b", {0.6, -2, 0}, {0.8, 2, 0.2});
    test::Triangles ground;
    ground.points = {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}};
    ground.triangles = {{0, 1, 2}, {0, 2, 3}};
    test::add_object(scene, "ground", ground);
    const std::vector<Gap<3>> gaps = gaps_of(scene, 0.8);
    ASSERT_EQ(gaps.size(), 1u);
    EXPECT_NEAR(gaps[0].width, 0.4, 1e-5);
    EXPECT_GT(gaps[0].position.y, 0);
}

TEST(Gaps, InsideOfABodyIsNoPassage) {
    Scene scene;
    test::add_object(scene, "wall", test::corner_triangles(0.5f));
    EXPECT_TRUE(gaps_of(scene, 0.8).empty()) << "it is 0.5 thick";
    test::add_box(scene, "a", {-5, -5, -1}, {-1, 5, 1});
    test::add_box(scene, "b", {-0.6, -5, -1}, {-0.25, 5, 1});
    EXPECT_EQ(gaps_of(scene, 0.8).size(), 1u);
    test::add_box(scene, "filling", {-2, -6, -2}, {0, 6, 2});
    EXPECT_TRUE(gaps_of(scene, 0.8).empty());
}

TEST(Gaps, OnlyBetweenWantedObjects) {
    test::PlaneLevel level;
    for (int i = 0; i < 3; ++i)
        level.add_box(std::to_string(i), {1.5f * static_cast<float>(i), 0}, {1.5f * static_cast<float>(i) + 1, 1});
    GapOptions<2> options{0.8, 0.1};
    EXPECT_EQ(find_gaps(FacetTree<2>(level.view_of().objects), options).size(), 2u);
    options.is_selected = [](std::size_t a, std::size_t b) { return a + b == 3; };
    EXPECT_EQ(find_gaps(FacetTree<2>(level.view_of().objects), options).size(), 1u);
}

}  // namespace
}  // namespace abut::tool
