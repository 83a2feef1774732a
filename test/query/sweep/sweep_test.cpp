// Linear sweeps with known answers.

#include "../../oracle/expect.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/detail/sweep/linear.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

/// A level floor at height 0 of squares, each 1 wide and made of two triangles.
Mesh floor_of_squares(int count) {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (int z = 0; z <= count; ++z)
        for (int x = 0; x <= count; ++x) points.push_back({x, 0, z});
    const auto at = [&](int x, int z) { return static_cast<std::uint32_t>(z * (count + 1) + x); };
    for (int z = 0; z < count; ++z)
        for (int x = 0; x < count; ++x) {
            triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
            triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
        }
    return *Mesh::build(points, triangles);
}

TEST(Sweep, OfTwoBallsEndsWhereTheyTouch) {
    const auto hit = sweep(Sphere{{0, 0, 0}, 1}, Vec3(10, 0, 0), Sphere{{7, 0, 0}, 1});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->fraction, 0.5f);
    EXPECT_FLOAT_EQ(hit->distance, 5);
    EXPECT_TRUE(near(hit->normal, Vec3(-1, 0, 0)));
    EXPECT_TRUE(near(hit->point, Vec3(6, 0, 0)));
    EXPECT_FALSE(hit->started_inside);
}

TEST(Sweep, ReportsThePointInTheWorldWhenBothMove) {
    const auto hit = sweep(Sphere{{0, 0, 0}, 1}, Vec3(10, 4, 0), Sphere{{12, 0, 0}, 1}, Vec3(-10, 4, 0));
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->fraction, 0.5f);
    EXPECT_FLOAT_EQ(hit->distance, 10);
    EXPECT_TRUE(near(hit->point, Vec3(6, 2, 0)));
}

// `{}` could be a motion of B or options; it means options, and B rests.
TEST(Sweep, TakesEmptyBracesForOptions) {
    const Sphere a{{0, 0, 0}, 1}, b{{7, 0, 0}, 1};
    const Vec3 displacement(10, 0, 0);
    EXPECT_EQ(sweep(a, displacement, b, {})->fraction, 0.5f);
    EXPECT_EQ(sweep(a, {10, 0, 0}, b, {})->fraction, 0.5f);
    EXPECT_EQ(sweep(View<3>(view(a)), displacement, View<3>(view(b)), {})->fraction, 0.5f);
    EXPECT_EQ(sweep(a, displacement, b, {}, {})->fraction, 0.5f);
    EXPECT_EQ(sweep(a, displacement, b, {-10, 0, 0})->fraction, 0.25f) << "a motion in braces stays one";
    Cache cache;
    EXPECT_EQ(sweep(a, displacement, b, {.cache = &cache})->fraction, 0.5f) << "and options with something in them";
    EXPECT_EQ(sweep(Circle{{0, 0}, 1}, Vec2(10, 0), Circle{{7, 0}, 1}, {})->fraction, 0.5f);
    const Motion3 rotating{{}, displacement, {0, 1, 0}};
    EXPECT_NEAR(sweep(a, rotating, b, {})->fraction, 0.5f, 1e-5f);
    EXPECT_NEAR(sweep(a, rotating, b, {{}, {-10, 0, 0}})->fraction, 0.25f, 1e-5f);
}

TEST(Sweep, OfABoxUpToItsEndIsAHit) {
    const auto hit = sweep(Box2{{0, 3}, {1, 1}}, Vec2(0, -2), HalfSpace2{{0, 1}, 0});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->fraction, 1);
    EXPECT_TRUE(near(hit->normal, Vec2(0, 1)));
    EXPECT_FALSE(sweep(Box2{{0, 3}, {1, 1}}, Vec2(0, -1.99f), HalfSpace2{{0, 1}, 0}));
}

TEST(Sweep, OfABoxAtABox) {
    const auto hit = sweep(Box3{{0, 0, 0}, {1, 1, 1}}, Vec3(8, 1, 0), Box3{{5, 0, 0}, {1, 2, 1}});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->fraction, 3.0f / 8);
    EXPECT_TRUE(near(hit->normal, Vec3(-1, 0, 0)));
    EXPECT_FLOAT_EQ(hit->point.x, 4);
    EXPECT_EQ(hit->feature.kind, FeatureKind::face);
}

TEST(Sweep, AwayOrBesideIsNoHit) {
    const Box3 box{{0, 0, 0}, {1, 1, 1}}, other{{5, 0, 0}, {1, 1, 1}};
    EXPECT_FALSE(sweep(box, Vec3(-10, 0, 0), other));
    EXPECT_FALSE(sweep(box, Vec3(10, 7, 0), other));
    EXPECT_FALSE(sweep(box, Vec3(0, 0, 0), other));
    EXPECT_FALSE(sweep(box, Vec3(10, 0, 0), other, Vec3(10, 0, 0)));
}

TEST(Sweep, OfWhatTouchesIsAHitOnlyFurtherIn) {
    const Box3 crate{{0, 1, 0}, {1, 1, 1}};
    const Box3 floor{{0, -1, 0}, {50, 1, 50}};
    EXPECT_FALSE(sweep(crate, Vec3(20, 0, 0), floor));
    EXPECT_FALSE(sweep(crate, Vec3(20, 1, 0), floor));
    const auto hit = sweep(crate, Vec3(20, -1, 0), floor);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->fraction, 0);
    EXPECT_FALSE(hit->started_inside);
    EXPECT_TRUE(near(hit->normal, Vec3(0, 1, 0)));
    EXPECT_FALSE(sweep(crate, Vec3(20, 0, 0), HalfSpace3{{0, 1, 0}, 0}));
    EXPECT_TRUE(sweep(crate, Vec3(20, -1, 0), HalfSpace3{{0, 1, 0}, 0}));
}

TEST(Sweep, OfWhatIsDeepInIsAHitOnlyFurtherIn) {
    const Box3 floor{{0, -1, 0}, {50, 1, 50}}, sunk{{0, 0.9f, 0}, {1, 1, 1}};
    EXPECT_FALSE(sweep(sunk, Vec3(20, 0, 0), floor));
    EXPECT_FALSE(sweep(sunk, Vec3(0, 5, 0), floor));
    const auto hit = sweep(sunk, Vec3(0, -5, 0), floor);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->fraction, 0);
    EXPECT_TRUE(hit->started_inside);
    EXPECT_TRUE(near(hit->normal, Vec3(0, 1, 0)));
}

TEST(Sweep, SlidesOverTheSeamsOfAMesh) {
    const Mesh floor = floor_of_squares(16);
    for (const float lift : {0.0f, 1e-6f, -1e-6f}) {
        const Box3 crate{{2.3f, 0.5f + lift, 2.6f}, {0.5f, 0.5f, 0.5f}};
        EXPECT_FALSE(sweep(crate, Vec3(10, 0, 7), floor)) << lift;
        const Box3 wall{{9, 1, 8}, {0.5f, 1, 8}};
        EXPECT_TRUE(sweep(crate, Vec3(10, 0, 7), wall));
    }
    const auto hit = sweep(Box3{{2.3f, 1.5f, 2.6f}, {0.5f, 0.5f, 0.5f}}, Vec3(10, -2, 0), floor);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, 0.5, 1e-6);
    EXPECT_TRUE(near(hit->normal, Vec3(0, 1, 0)));
    EXPECT_NEAR(hit->point.y, 0, 1e-6);
}

TEST(Sweep, SlidesOverAPartThatItLeavesBehind) {
    // The mover approaches it, slides along it and leaves it, all on one level.
    const Triangle3 tile{{3, 0, -4}, {3, 0, 4}, {4, 0, -4}};
    for (const float lift : {0.0f, 1e-6f, -1e-6f})
        EXPECT_FALSE(sweep(Box3{{2, 0.5f + lift, 0.3f}, {0.5f, 0.5f, 0.5f}}, Vec3(14, 0, 0), tile)) << lift;
}

TEST(Sweep, GoesThroughWhatIsThinAtTheLeastSlope) {
    const Triangle3 tile{{3, 0, -4}, {3, 0, 4}, {9, 0, -4}};
    const auto hit = sweep(Segment<3>{{0, 2e-5f, 0}, {0.1f, 2e-5f, 0.1f}}, Vec3(14, -5e-5f, 0), tile);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 5.6, 1e-2);
}

TEST(Sweep, GoesOnBehindThePartsThatItLeaves) {
    // The mover slides on a floor between two walls: it hits the wall and not the floor.
    const std::vector<Vec3> points{{-10, 0, -10}, {-10, 0, 10}, {10, 0, -10}, {10, 0, 10},
                                   {5, -1, -10},  {5, -1, 10},  {5, 9, 0}};
    const Mesh room = *Mesh::build(points, std::vector<glm::uvec3>{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}});
    const auto hit = sweep(Box3{{0, 1, 0}, {1, 1, 1}}, Vec3(20, 0, 0), room);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 4, 1e-5);
    EXPECT_EQ(hit->feature.part, 2u);
    EXPECT_TRUE(near(hit->normal, Vec3(-1, 0, 0)));
}

TEST(Sweep, OfAMeshAtAShapeIsThatOfTheShapeAtTheMesh) {
    const Mesh floor = floor_of_squares(8);
    const Sphere ball{{3.3f, 4, 4.1f}, 0.5f};
    const auto down = sweep(ball, Vec3(1, -8, 0), floor), up = sweep(floor, Vec3(-1, 8, 0), ball);
    ASSERT_TRUE(down && up);
    EXPECT_NEAR(down->fraction, up->fraction, 1e-6);
    EXPECT_TRUE(near(down->normal, -up->normal));
    EXPECT_NEAR(down->point.y, 0, 1e-5);
    EXPECT_NEAR(up->point.y, 3.5, 1e-5);
    const auto meshes = sweep(at(floor, Pose3{{0, 3, 0}}), Vec3(0, -6, 0), floor);
    ASSERT_TRUE(meshes);
    EXPECT_NEAR(meshes->fraction, 0.5, 1e-6);
}

TEST(Sweep, OfABulletDoesntTunnel) {
    // Each step is 1e4 times the mover's size; the wall is 1e-3 thick.
    const Sphere bullet{{-3000, 0.2f, 0.1f}, 0.5f};
    const Box3 wall{{1.25f, 0, 0}, {5e-4f, 4, 4}};
    const auto hit = sweep(bullet, Vec3(5000, 0, 0), wall);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 3000.7495, 1e-3);
    const Box3 slug{{-3000, 0.2f, 0.1f}, {0.5f, 0.1f, 0.1f}, turn_about({0, 0, 1}, 0.3f)};
    EXPECT_TRUE(sweep(slug, Vec3(5000, 0, 0), wall));
    EXPECT_TRUE(sweep(slug, Vec3(5000, 0, 0), Triangle<3>{{1, -9, -9}, {1, 9, -9}, {1, 0, 9}}));
    EXPECT_TRUE(sweep(Sphere{{-3000, 0, 0}, 0}, Vec3(5000, 0, 0), Triangle<3>{{1, -9, -9}, {1, 9, -9}, {1, 0, 9}}));
    EXPECT_TRUE(sweep(Circle{{-3000, 0}, 0}, Vec2(5000, 0), Segment<2>{{1, -9}, {1, 9}}));
    EXPECT_TRUE(sweep(Segment<2>{{-3000, 0}, {-2999, 0.5f}}, Vec2(1e30f, 0), Segment<2>{{1, -9}, {1, 9}}));
}

TEST(Sweep, OfRoundAndOfUsersShapes) {
    const auto onto =
        sweep(Cylinder{{0, 3, 0}, {0, 5, 0}, 1}, Vec3(0, -4, 0), Cylinder{{0.3f, -1, 0}, {0.3f, 1, 0}, 2});
    ASSERT_TRUE(onto);
    EXPECT_NEAR(onto->fraction, 0.5, 1e-4);
    const auto apex = sweep(Cone{{0, 0, 0}, {2, 0, 0}, 1}, Vec3(8, 0, 0), Box3{{7, 0, 0}, {1, 1, 1}});
    ASSERT_TRUE(apex);
    EXPECT_NEAR(apex->distance, 4, 1e-4);
    EXPECT_TRUE(near(apex->point, Vec3(6, 0, 0), 1e-4));
    const auto egg = sweep(stretched(Sphere{{0, 0, 0}, 1}, Vec3(3, 1, 1)), Vec3(10, 0, 0), Sphere{{9, 0, 0}, 1});
    ASSERT_TRUE(egg);
    EXPECT_NEAR(egg->distance, 5, 1e-4);
}

TEST(Sweep, IsEarlyAndNotMissedWhereTheSearchGivesUp) {
    const Capsule3 a{{-9, 0, 0}, {-8, 0.3f, 0.2f}, 0.5f};
    const auto b = rounded(Box3{{0, 0, 0}, {0.1f, 2, 0.1f}, glm::quat(0.6f, 0, 0, 0.8f)}, 0.4f);
    const Path<3> path{normalized(DVec<3>(1, 0.01, 0.02)), 20};
    LinearImpact<3> whole, early;
    ASSERT_TRUE(time_of_impact(view(a), path, view(b), 0, {}, whole));
    double last = -1;
    for (const int steps : {1, 2, 3}) {
        ASSERT_TRUE(time_of_impact(view(a), path, view(b), 0, {.max_iterations = steps}, early)) << steps;
        EXPECT_GT(early.along, last);
        EXPECT_LE(early.along, whole.along);
        last = early.along;
    }
}

TEST(Sweep, HasTheSameHitWithATrace) {
    const Box2 mover{{-3, 1}, {0.7f, 0.5f}, Turn::by(0.35f)};
    const Triangle2 wall{{1, -1}, {3, 0}, {1, 1}};
    Trace<2> trace;
    const auto traced = sweep(mover, Vec2(6, -1), wall, {.trace = &trace}), untraced = sweep(mover, Vec2(6, -1), wall);
    ASSERT_TRUE(traced && untraced);
    EXPECT_NEAR(traced->fraction, untraced->fraction, 1e-6);
    EXPECT_TRUE(near(traced->normal, untraced->normal, 1e-5));
    ASSERT_GE(trace.steps.size(), 2u);
    const auto& last = std::get<SweepStep<2>>(trace.steps.back());
    EXPECT_TRUE(near(last.position, Vec2(-6, 1) * traced->fraction, 1e-5));
    EXPECT_NEAR(last.distance, 0, 1e-5);
}

}  // namespace
}  // namespace abut
