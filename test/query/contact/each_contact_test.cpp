// Contacts of all parts: internal edges of a floor give no ghost collisions, and real edges give contacts.

#include "../../oracle/expect.hpp"
#include "../../shape/brushes.hpp"
#include "../../shape/meshes.hpp"
#include "floors.hpp"
#include <abut/query/each_contact.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/tile_map.hpp>

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;
using namespace test;

constexpr std::uint64_t seed = 20260722;

/// The faces of all tiles as one SolidBsp.
SolidBsp3 solid_of_faces(const Pieces<Box3>& boxes) {
    test::Surface surface;
    for (const Box3& box : boxes.pieces)
        surface = joined(surface, test::box_surface(box.center - box.half, box.center + box.half));
    return *SolidBsp3::build(surface.points, surface.triangles);
}
SolidBsp2 solid_of_faces(const Pieces<Box2>& boxes) {
    std::vector<Vec2> points;
    std::vector<glm::uvec2> faces;
    for (const Box2& box : boxes.pieces) {
        const auto first = static_cast<std::uint32_t>(points.size());
        for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
            points.push_back(box.center + box.half * corner);
        for (std::uint32_t i = 0; i < 4; ++i) faces.emplace_back(first + i, first + (i + 1) % 4);
    }
    return *SolidBsp2::build(points, faces);
}

template <int D>
Pose<D> turned_about_up(double radians, const Vec<D>& position) {
    if constexpr (D == 2)
        return {position, no_rotation<2>};
    else
        return {position, turn_about({0, 1, 0}, static_cast<float>(radians))};
}

/// The tolerance of normals and depths. A floor with coordinates perturbed by 1e-6 has real edges, and a substitute
/// normal has their error.
struct Tolerance {
    double aside = 1e-6, depth = 1e-5;
};
Tolerance tolerance(const Random* random) {
    return random != nullptr ? Tolerance{1e-3, 1e-5} : Tolerance{};
}

/// Puts the shape, with its lowest point at height -`reach`, on the floor at random positions, and counts the contacts
/// with a sideways normal.
template <int D, class S, class Floor>
void expect_only_up(const char* name, const S& shape, float reach, const Floor& floor, const Tolerance& tolerance) {
    Random random(seed);
    double most_aside = 0, least_deep = 1, most_deep = -1;
    int contacts = 0;
    for (int i = 0; i < 150; ++i) {
        const double depth = random.uniform(-0.01, 0.05);
        Vec<D> position(0.0f);
        for (int axis = 0; axis < D; ++axis) position[axis] = random.uniform_float(1.5, tiles - 1.5);
        // Every second position is on an internal edge.
        if (random.chance(0.5)) position[0] = std::round(position[0]);
        if (D == 3 && random.chance(0.3)) position[2 % D] = std::round(position[2 % D]);
        position[1] = reach - static_cast<float>(depth);
        const double angle = random.chance(0.3) ? 0 : random.uniform(0, 6.28);
        const auto placed = at(shape, turned_about_up<D>(angle, position));
        double deep = -1;
        each_contact(placed, floor,
                     [&](const Contact<D>& contact) {
                         ++contacts;
                         DVec<D> aside(contact.normal);
                         EXPECT_LT(aside[1], 0) << name << ' ' << i;
                         aside[1] = 0;
                         most_aside = std::max(most_aside, length(aside));
                         deep = std::max(deep, static_cast<double>(contact.depth));
                     },
                     {.margin = 0.02f});
        least_deep = std::min(least_deep, deep - depth);
        most_deep = std::max(most_deep, deep - depth);
        const Contact<D> one = contact(placed, floor, {.margin = 0.02f});
        EXPECT_NEAR(static_cast<double>(one.normal[1]), -1, tolerance.aside) << name << ' ' << i;
        EXPECT_NEAR(static_cast<double>(one.depth), depth, tolerance.depth) << name << ' ' << i;
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GE(contacts, 150) << name;
    EXPECT_LT(most_aside, tolerance.aside) << name;
    EXPECT_GT(least_deep, -tolerance.depth) << name;
    EXPECT_LT(most_deep, tolerance.depth) << name;
}

template <class Floor>
void expect_level_in_space(const char* name, const Floor& floor, const Tolerance& tolerance) {
    SCOPED_TRACE(name);
    expect_only_up<3>("box", Box3{{0, 0, 0}, {0.4f, 0.3f, 0.6f}}, 0.3f, floor, tolerance);
    expect_only_up<3>("small box", Box3{{0, 0, 0}, {0.1f, 0.3f, 0.1f}}, 0.3f, floor, tolerance);
    expect_only_up<3>("long box", Box3{{0, 0, 0}, {1.4f, 0.3f, 0.1f}}, 0.3f, floor, tolerance);
    expect_only_up<3>("ball", Sphere{{0, 0, 0}, 0.3f}, 0.3f, floor, tolerance);
    expect_only_up<3>("standing capsule", Capsule3{{0, -0.2f, 0}, {0, 0.2f, 0}, 0.3f}, 0.5f, floor, tolerance);
    expect_only_up<3>("lying capsule", Capsule3{{-1, 0, 0}, {1, 0, 0}, 0.3f}, 0.3f, floor, tolerance);
    expect_only_up<3>("cylinder", Cylinder{{0, -0.3f, 0}, {0, 0.3f, 0}, 0.4f}, 0.3f, floor, tolerance);
}

TEST(EachContact, OfALevelFloorIsUpAlone) {
    Random perturbation(seed);
    for (Random* random : {static_cast<Random*>(nullptr), &perturbation}) {
        expect_level_in_space("mesh", level_mesh(random), tolerance(random));
        expect_level_in_space("broken mesh", broken_mesh(random), tolerance(random));
        expect_level_in_space("boxes", boxes_in_space(random), tolerance(random));
        expect_level_in_space("solid lumps", solid_of_boxes(boxes_in_space(random).pieces), tolerance(random));
        expect_level_in_space("solid of faces", solid_of_faces(boxes_in_space(random)), tolerance(random));
        for (const SolidBsp2& solid :
             {solid_of_boxes(boxes_of_the_plane(random).pieces), solid_of_faces(boxes_of_the_plane(random))}) {
            expect_only_up<2>("box on a solid", Box2{{0, 0}, {0.4f, 0.3f}}, 0.3f, solid, tolerance(random));
            expect_only_up<2>("ball on a solid", Circle{{0, 0}, 0.3f}, 0.3f, solid, tolerance(random));
        }
        {
            const Tolerance off = tolerance(random);
            expect_only_up<2>("box", Box2{{0, 0}, {0.4f, 0.3f}}, 0.3f, boxes_of_the_plane(random), off);
            expect_only_up<2>("small box", Box2{{0, 0}, {0.1f, 0.3f}}, 0.3f, boxes_of_the_plane(random), off);
            expect_only_up<2>("ball", Circle{{0, 0}, 0.3f}, 0.3f, boxes_of_the_plane(random), off);
            expect_only_up<2>("box", Box2{{0, 0}, {0.4f, 0.3f}}, 0.3f, segments(random), off);
            expect_only_up<2>("small box", Box2{{0, 0}, {0.1f, 0.3f}}, 0.3f, segments(random), off);
            expect_only_up<2>("capsule", Capsule2{{-1, 0}, {1, 0}, 0.3f}, 0.3f, segments(random), off);
        }
    }
}

template <int D, class A, class B>
std::vector<Contact<D>> contacts_of(const A& a, const B& b, float margin = 0) {
    std::vector<Contact<D>> result;
    each_contact(a, b, [&](const Contact<D>& contact) { result.push_back(contact); }, {.margin = margin});
    return result;
}

TEST(EachContact, ReportsWallsAndTheFloorBeforeThem) {
    // A floor of boxes at height 0 carries a wall of boxes from 4 on.
    Pieces<Box2> level = boxes_of_the_plane(nullptr);
    for (int y = 0; y < 4; ++y) level.pieces.push_back({{4.5f, static_cast<float>(y) + 0.5f}, {0.5f, 0.5f}});
    const auto contacts = contacts_of<2>(Box2{{3.51f, 0.99f}, {0.5f, 1.0f}}, level);
    int up = 0, aside = 0;
    for (const Contact<2>& contact : contacts) {
        up += contact.normal.y < -0.9999f ? 1 : 0;
        aside += contact.normal.x > 0.9999f ? 1 : 0;
        EXPECT_NEAR(contact.depth, 0.01, 1e-5);
    }
    EXPECT_GT(up, 0);
    EXPECT_GT(aside, 0);
    EXPECT_EQ(static_cast<std::size_t>(up + aside), contacts.size());
}

TEST(EachContact, ReportsACornerThatPointsIntoACorner) {
    const Pieces<Segment2> corner{{{{-3, 0}, {0, 0}}, {{0, 0}, {0, 3}}}};
    // The tip touches both.
    const Polygon wedge = *Polygon::build(std::vector<Vec2>{{0, 0}, {-0.6f, 0.2f}, {-0.2f, 0.6f}});
    const auto contacts = contacts_of<2>(wedge, corner, 1e-3f);
    ASSERT_EQ(contacts.size(), 2u);
    for (const Contact<2>& contact : contacts)
        EXPECT_TRUE(contact.normal.y < -0.999f || contact.normal.x > 0.999f) << contact.normal.x;
}

/// The tip is in both, far deeper than the threshold of the internal-edge filter.
TEST(EachContact, ReportsACornerThatIsDeepInACorner) {
    const Pieces<Box2> level{{{{4, -0.5f}, {4, 0.5f}}, {{4.5f, 2}, {0.5f, 2}}}};
    for (const float depth : {0.005f, 0.02f, 0.05f}) {
        const Vec2 tip(4 + depth, -depth);
        const Polygon wedge = *Polygon::build(std::vector<Vec2>{tip, tip + Vec2(-0.6f, 0.2f), tip + Vec2(-0.2f, 0.6f)});
        const auto contacts = contacts_of<2>(wedge, level);
        int up = 0, aside = 0;
        for (const Contact<2>& contact : contacts) {
            up += contact.normal.y < -0.999f ? 1 : 0;
            aside += contact.normal.x > 0.999f ? 1 : 0;
            EXPECT_NEAR(contact.depth, depth, 1e-5);
        }
        EXPECT_GT(up, 0) << depth;
        EXPECT_GT(aside, 0) << depth;
        EXPECT_EQ(static_cast<std::size_t>(up + aside), contacts.size()) << depth;
    }
}

/// Planks side by side on a floor: all corners of their contact area lie in floor or ceiling.
TEST(EachContact, ReportsAWallBetweenFloorAndCeiling) {
    const Pieces<Box3> level{
        {{{0, -1, 0}, {20, 1, 20}}, {{0, 1.2f, 0}, {20, 1, 20}}, {{0.5f, 0.1f, 0}, {0.5f, 0.1f, 9}}}};
    const Box3 plank{{-0.49f, 0.1f, 0.3f}, {0.5f, 0.102f, 9}};
    int aside = 0;
    for (const Contact<3>& contact : contacts_of<3>(plank, level)) aside += contact.normal.x > 0.999f ? 1 : 0;
    EXPECT_EQ(aside, 1);
}

TEST(EachContact, ReportsRealEdges) {
    // A ball hangs over the end of the floor.
    const auto over_end = contacts_of<2>(Circle{{-0.3f, 0.38f}, 0.5f}, segments(nullptr));
    ASSERT_EQ(over_end.size(), 1u);
    EXPECT_NEAR(over_end[0].normal.x, 0.6199, 1e-3);

    // A ball lies on top of a ridge of two slopes, or on one side.
    const Pieces<Segment2> ridge{{{{-2, -2}, {0, 0}}, {{0, 0}, {2, -2}}}};
    const auto on_top = contacts_of<2>(Circle{{0.05f, 0.49f}, 0.5f}, ridge);
    for (const Contact<2>& contact : on_top) EXPECT_NEAR(contact.normal.x, -0.1015, 1e-3);
    EXPECT_GE(on_top.size(), 1u);
    const auto on_side = contacts_of<2>(Circle{{0.5f, 0.2f}, 0.5f}, ridge);
    ASSERT_EQ(on_side.size(), 1u);
    EXPECT_NEAR(on_side[0].normal.x, -0.70710678, 1e-4);

    // The step is twenty times as high as the threshold of the internal-edge filter.
    Pieces<Box2> step = boxes_of_the_plane(nullptr);
    step.pieces.push_back({{4.5f, -0.49f}, {0.5f, 0.5f}});
    bool aside = false;
    for (const Contact<2>& contact : contacts_of<2>(Box2{{3.502f, 0.5f}, {0.5f, 0.5f}}, step))
        aside = aside || contact.normal.x > 0.99f;
    EXPECT_TRUE(aside);
}

/// A slab on a ridge of two slopes whose corners are a little apart: a contact of 0.01 came out as 0.5 deep and leant
/// by 17 degrees, because the surface towards the slab's middle, which is an edge there, counted as a plane.
TEST(EachContact, ReportsARidgeOfTwoPieces) {
    for (const float gap : {0.0f, 1e-6f, 1e-5f, 5e-5f, 1e-4f, 2e-4f, 1e-3f}) {
        SCOPED_TRACE(gap);
        const std::vector<Vec3> points{{-3, -3, -3}, {-3, -3, 3}, {0, 0, -3},        {0, 0, 3},
                                       {gap, 0, -3}, {gap, 0, 3}, {gap + 3, -3, -3}, {gap + 3, -3, 3}};
        const Mesh ridge = *Mesh::build(points, std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {6, 5, 7}});
        int count = 0;
        each_contact(Box3{{0.3f, 0.99f, 0}, {2, 1, 1}}, ridge, [&](const Contact<3>& found) {
            ++count;
            EXPECT_LT(found.normal.y, -0.9999f);
            EXPECT_NEAR(found.depth, 0.01f, 1e-5f);
            EXPECT_GE(found.points.size(), 2u);
            return true;
        });
        EXPECT_EQ(count, 1);
    }
}

TEST(EachContact, OfConvexShapesIsTheirContact) {
    const Box3 a{{0, 0, 0}, {1, 1, 1}}, b{{1.9f, 0.2f, 0}, {1, 1, 1}};
    const auto contacts = contacts_of<3>(a, b);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].normal, contact(a, b).normal);
    EXPECT_EQ(contacts[0].depth, contact(a, b).depth);
    EXPECT_TRUE(contacts_of<3>(a, Box3{{3, 0, 0}, {0.9f, 1, 1}}).empty());
}

TEST(EachContact, StopsWhenTheVisitorSaysSo) {
    // A ball in a cube of boxes touches six surfaces.
    Pieces<Box3> walls;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            Box3 wall{{0, 0, 0}, {1, 1, 1}};
            wall.center[axis] = 1.45f * side;
            walls.pieces.push_back(wall);
        }
    int count = 0, all = 0;
    each_contact(Sphere{{0, 0, 0}, 0.5f}, walls, [&](const Contact<3>&) { ++all; });
    each_contact(Sphere{{0, 0, 0}, 0.5f}, walls, [&](const Contact<3>&) { return ++count < 3; });
    EXPECT_EQ(all, 6);
    EXPECT_EQ(count, 3);
}

/// More pairs of parts touch, on more planes, than are stored at once. Those of the bottom are the deepest and the
/// least deep ones, and those of all other sides come between.
TEST(EachContact, ReportsEachPlaneOnceHoweverManyPartsTouch) {
    constexpr int sides = 90, bottom_parts = 12;
    const auto on_circle = [](double side, double radius) {
        const double angle = std::acos(-1.0) * side / sides;
        return Vec2(radius * std::cos(angle), radius * std::sin(angle));
    };
    std::vector<Vec2> shape{{-10.05f, -0.1f}, {10.09f, -0.04f}}, level;
    for (int i = 1; i < sides; ++i) shape.push_back(on_circle(i, 10.09 - 0.04 * i / sides));
    for (int i = 0; i < bottom_parts; ++i) level.emplace_back(-10 + 20.0 * i / bottom_parts, 0);
    for (int i = 0; i < sides; ++i) {
        level.push_back(on_circle(i, 10));
        level.push_back((on_circle(i, 10) + on_circle(i + 1, 10)) * 0.5f);
    }
    const Polygon polygon = *Polygon::build(shape);
    const Chain chain = *Chain::build(level, true);
    std::vector<Contact<2>> all;
    each_contact(polygon, chain, [&](const Contact<2>& found) { all.push_back(found); });
    EXPECT_EQ(all.size(), sides + 1u);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_LT(dot(all[i].normal, all[j].normal), 0.9999f) << i << " " << j;
}

TEST(EachContact, FromTheOtherSideIsTheSameTurnedRound) {
    const Box3 box{{4, 0.29f, 4}, {0.7f, 0.3f, 0.7f}};
    const Mesh floor = level_mesh(nullptr);
    const auto one = contacts_of<3>(box, floor), other = contacts_of<3>(floor, box);
    EXPECT_EQ(one.size(), other.size());
    for (const Contact<3>& contact : other) EXPECT_NEAR(contact.normal.y, 1, 1e-5);
}

/// Regression: a wall of triangles with a corner stands on a floor of triangles that share no vertices with it. Some
/// triangles of its sole touch the floor's in a vertex alone, with normals along the floor. Their substitute plane was
/// the wall's own side, and the floor was reported 0.3 deep.
TEST(EachContact, AWallStandsOnItsFloorWhicheverIsFirst) {
    const std::vector<Vec2> outline{{6, 2}, {3, 2}, {3, 2.3f}, {5.7f, 2.3f}, {5.7f, 5}, {6, 5}};
    const std::vector<glm::uvec3> sole{{2, 3, 0}, {2, 0, 1}, {3, 4, 5}, {3, 5, 0}};
    for (const float up : {1.0f, -1.0f}) {
        std::vector<Vec3> points;
        std::vector<glm::uvec3> triangles;
        for (const float height : {0.0f, 1.2f * up})
            for (const Vec2& p : outline) points.emplace_back(p.x, height, p.y);
        for (const glm::uvec3& t : sole) {
            triangles.push_back(t);
            triangles.emplace_back(t.x + 6, t.z + 6, t.y + 6);
        }
        for (std::uint32_t i = 0; i < 6; ++i) {
            const std::uint32_t next = (i + 1) % 6;
            triangles.emplace_back(i, i + 6, next + 6);
            triangles.emplace_back(i, next + 6, next);
        }
        const Mesh wall = *Mesh::build(points, triangles), floor = level_mesh(nullptr);
        for (const Contact<3>& found : {contact(wall, floor), contact(floor, wall)}) {
            ASSERT_TRUE(found);
            EXPECT_LT(found.depth, 1e-6f);
        }
        const auto is_on_it = [](const Contact<3>& found) {
            EXPECT_LT(found.depth, 1e-6f) << found.feature_a.part << " " << found.feature_b.part;
        };
        each_contact(wall, floor, is_on_it);
        each_contact(floor, wall, is_on_it);
    }
}

/// Regression: the search around a shape of size 0 never grew. It was endless for a point that wasn't exactly in the
/// center of its box.
TEST(EachContact, OfWhatHasNoSizeComesToAnEnd) {
    Random random(seed);
    const Pieces<Box3> boxes = boxes_in_space(&random);
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", number " + std::to_string(i));
        const Pose3 pose{Vec3(random.in_cube<3>()), random.rotation<3>()};
        const Vec3 place = pose * (Vec3(4, -0.5f, 4) + Vec3(random.in_cube<3>()) * Vec3(3, 0.4f, 3));
        const std::vector<Vec3> points{place, place, place};
        const Mesh dot = *Mesh::build(points, std::vector<glm::uvec3>{{0, 1, 2}});
        const auto floor = at(boxes, pose);
        EXPECT_GT(contact(dot, floor).depth, 0);
        EXPECT_GT(contact(floor, dot).depth, 0);
        EXPECT_GT(contact(Sphere{place, 0}, floor).depth, 0);
    }
}

/// The rounds for pairs that touch have an end: of two maps of 100 x 100 tiles they took 96 s.
TEST(EachContact, OfLevelsOnTopOfEachOtherEnds) {
    constexpr std::uint32_t side = 150;
    const TileMap map = *TileMap::build(std::vector<Tile>(side * side, Tile::full), side, 1);
    const auto shifted = at(map, Pose2{{0.25f, 0.125f}});
    EXPECT_EQ(contact(map, shifted).depth, 0.75f);
    int count = 0;
    each_contact(map, shifted, [&](const Contact<2>& found) {
        EXPECT_GT(found.depth, 0);
        ++count;
    });
    EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace abut
