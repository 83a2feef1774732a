// Sweeps with rotation: examples with known answers, the definitions of hit and resting contact, every kind of shape,
// and the iteration limit.

#include "../../oracle/expect.hpp"
#include "../../oracle/random.hpp"
#include "../../shape/meshes.hpp"
#include "../hash.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/detail/sweep/rotating.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>

#include <numbers>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

// Examples in 2D.

TEST(SweepRotating, ARodThatTurnsOnceAroundMeetsAPost) {
    // The rod's end reaches the post's near side, at a distance of 0.9 from the hub, with its lower edge at angle a:
    // its half width 0.1 over that distance is below the post, sin a = 0.1 / 0.9.
    const Box2 rod{{0, 0}, {1, 0.1f}};
    const Circle post{{0, 1}, 0.1f};
    const auto hit = sweep(rod, Motion2{{}, {}, 2 * std::numbers::pi_v<float>}, post);
    ASSERT_TRUE(hit);
    // The rod's long side hits the circle: the center is 1 from the hub, and 0.2 off the axis.
    EXPECT_NEAR(hit->fraction * 2 * std::numbers::pi_v<float>, std::acos(0.2), 1e-5);
    EXPECT_FALSE(hit->started_inside);
    EXPECT_EQ(hit->distance, 0);
    // The normal faces the rod, and the point is on the circle.
    EXPECT_NEAR(length(DVec<2>(hit->point) - DVec<2>(0, 1)), 0.1, 1e-5);
    EXPECT_GT(hit->normal.x, 0.9f);
    // Beyond the reach of the rod there is no hit, even in five revolutions.
    EXPECT_FALSE(sweep(rod, Motion2{{}, {}, 10 * std::numbers::pi_v<float>}, Circle{{0, 1.2f}, 0.1f}));
    // A motion between equal poses has no hit.
    EXPECT_FALSE(sweep(rod, Pose2{}, Pose2{}, post, Pose2{}, Pose2{}));
}

TEST(SweepRotating, BothTurn) {
    // The teeth of two gears rotate against each other at the same speed: their tips touch midway.
    const Segment<2> tooth{{0, 0}, {1, 0}};
    const auto later =
        sweep(tooth, Motion2{{{0, 0}, Turn::by(-std::numbers::pi_v<float> / 2)}, {}, std::numbers::pi_v<float>}, tooth,
              Motion2{{{1.2f, 0}, Turn::by(1.5f * std::numbers::pi_v<float>)}, {}, -std::numbers::pi_v<float>});
    ASSERT_TRUE(later);
    // At the angle below the line of centres at which half of 1.2 is the cosine.
    EXPECT_NEAR(later->fraction * std::numbers::pi_v<float>, std::numbers::pi_v<float> / 2 - std::acos(0.6), 1e-4);
    EXPECT_NEAR(later->point.x, 0.6, 1e-4);
}

TEST(SweepRotating, MovesAndTurns) {
    // A square moves to a wall and hits it with its corner, after 45 degrees.
    const Box2 square{{0, 0}, {1, 1}};
    const HalfSpace2 wall{{-1, 0}, -10};
    const auto hit =
        sweep(square, Motion2{{{0, 0}}, {(10 - std::sqrt(2.0f)) * 2, 0}, std::numbers::pi_v<float> / 2}, wall);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, 0.5, 1e-4);
    EXPECT_TRUE(near(hit->normal, Vec2(-1, 0)));
    EXPECT_NEAR(hit->distance, 10 - std::sqrt(2.0), 2e-3);
    EXPECT_NEAR(hit->point.x, 10, 1e-4);
}

// Resting contact.

TEST(SweepRotating, ABoxOnAFloorTurnsOnTheSpotAndSlides) {
    const Box3 box{{0, 0, 1}, {1, 1, 1}};
    const HalfSpace3 ground{{0, 0, 1}, 0};
    const Box3 slab{{0, 0, -1}, {20, 20, 1}};
    const auto plane = test::box_surface(Vec3(-20, -20, -1), Vec3(20, 20, 0)).mesh();
    for (const Motion3& motion :
         {Motion3{{}, {}, {0, 0, 2 * std::numbers::pi_v<float>}},
          Motion3{{}, {3, 1, 0}, {0, 0, -std::numbers::pi_v<float>}}, Motion3{{}, {5, 0, 0}, {}}}) {
        EXPECT_FALSE(sweep(box, motion, ground));
        EXPECT_FALSE(sweep(box, motion, slab));
        EXPECT_FALSE(sweep(box, motion, plane));
        EXPECT_FALSE(sweep(slab, Motion3{}, box, motion));
        EXPECT_FALSE(sweep(plane, Motion3{}, box, motion));
    }
}

TEST(SweepRotating, ACrateSlidesAndTurnsOverTheSeamsOfItsFloor) {
    const Box3 crate{{0, 0, 0.5f}, {0.5f, 0.5f, 0.5f}};
    const Box3 next_board{{2, 0, -0.5f}, {1, 3, 0.5f}};
    test::Surface tiles;
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 10; ++j) {
            const Vec3 corner(static_cast<float>(i) - 3, static_cast<float>(j) - 5, 0);
            tiles.add_quad({corner, corner + Vec3(1, 0, 0), corner + Vec3(1, 1, 0), corner + Vec3(0, 1, 0)},
                           i % 2 == 0);
        }
    const Mesh floor = tiles.mesh();
    for (const float yaw : {0.0f, 0.3f})
        for (const float turn : {0.0f, 0.5f, 3.0f}) {
            const Motion3 motion{{{-1, 0, 0}, turn_about({0, 0, 1}, yaw)}, {6, 0.3f, 0}, {0, 0, turn}};
            EXPECT_FALSE(sweep(crate, motion, next_board));
            EXPECT_FALSE(sweep(crate, motion, floor));
            // A slightly raised board stops it.
            Box3 higher = next_board;
            higher.center.z += 0.001f;
            EXPECT_TRUE(sweep(crate, motion, higher));
        }
}

TEST(SweepRotating, ABoxPivotsAboutItsEdge) {
    // A box on the floor rotates about an edge at the origin.
    const Box3 box{{1, 0, 1}, {1, 1, 1}};
    const HalfSpace3 ground{{0, 0, 1}, 0};
    const Box3 slab{{0, 0, -1}, {20, 20, 1}};
    const auto plane = test::box_surface(Vec3(-20, -20, -1), Vec3(20, 20, 0)).mesh();
    const Motion3 up{{}, {}, {0, -0.45f * std::numbers::pi_v<float>, 0}},
        down{{}, {}, {0, 0.45f * std::numbers::pi_v<float>, 0}},
        over{{}, {}, {0, -0.75f * std::numbers::pi_v<float>, 0}};
    const auto expect = [&](const auto& floor) {
        EXPECT_FALSE(sweep(box, up, floor));
        const auto in = sweep(box, down, floor);
        ASSERT_TRUE(in);
        EXPECT_EQ(in->fraction, 0);
        EXPECT_FALSE(in->started_inside);
        EXPECT_TRUE(near(in->normal, Vec3(0, 0, 1)));
        // It tips over the edge onto its side.
        const auto fallen = sweep(box, over, floor);
        ASSERT_TRUE(fallen);
        EXPECT_NEAR(fallen->fraction, 2.0 / 3, 2e-5);
        EXPECT_TRUE(near(fallen->normal, Vec3(0, 0, 1), 1e-3));
    };
    expect(ground);
    expect(slab);
    expect(plane);
}

TEST(SweepRotating, APlankOverAPostIsJudgedWhereTheyTouch) {
    // The post is under one half of the plank. That half goes up, and the other goes down beside the post.
    const Box2 plank{{0, 0.1f}, {2, 0.1f}};
    const Box2 post{{1, -1}, {0.25f, 1}};
    EXPECT_FALSE(sweep(plank, Motion2{{}, {}, std::numbers::pi_v<float> / 4}, post));
    const auto in = sweep(plank, Motion2{{}, {}, -std::numbers::pi_v<float> / 4}, post);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->fraction, 0);
}

TEST(SweepRotating, StartsThatOverlap) {
    const Box2 box{{0, 0}, {1, 1}};
    const auto from = [](float x) { return Pose2{{x, 0}}; };
    // Motions further in, out, and along.
    const auto in = sweep(box, Motion2{from(1.5f), {-1, 0}, 0.1f}, box);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->fraction, 0);
    EXPECT_TRUE(in->started_inside);
    EXPECT_TRUE(near(in->normal, Vec2(1, 0)));
    EXPECT_FALSE(sweep(box, Motion2{from(1.5f), {4, 0}, 0.1f}, box));
    EXPECT_FALSE(sweep(box, Motion2{from(1.5f), {0, 1}, 0}, box));
}

TEST(SweepRotating, WhatStartsInsideIsHitWhereItGetsDeeperThanItWas) {
    // A bar rotates about its end, which is in the floor; at the start, half of its other end is in the floor as well.
    const HalfSpace2 ground{{0, 1}, 0};
    const Box2 floor{{0, -10}, {20, 10}};
    const Box2 bar{{1, 0}, {1, 0.1f}};
    const auto expect = [&](const auto& below) {
        // The bar goes up and around. On the other side it is no deeper than at the start until its end touches.
        const auto around = sweep(bar, Motion2{{}, {}, 1.5f * std::numbers::pi_v<float>}, below);
        ASSERT_TRUE(around);
        EXPECT_GT(around->fraction * 1.5f * std::numbers::pi_v<float>, 3.1f);
        EXPECT_LT(around->fraction * 1.5f * std::numbers::pi_v<float>, 3.2f);
        EXPECT_TRUE(around->started_inside);
        EXPECT_FALSE(sweep(bar, Motion2{{}, {}, 0.9f * std::numbers::pi_v<float>}, below));
        // A bar that the motion lifts out first hits the ground as a bar from outside does.
        const auto lifted = sweep(bar, Motion2{{}, {0, 1.5f}, 1.5f * std::numbers::pi_v<float>}, below);
        ASSERT_TRUE(lifted);
        const Pose2 there = pose_at(Motion2{{}, {0, 1.5f}, 1.5f * std::numbers::pi_v<float>}, lifted->fraction);
        EXPECT_NEAR(closest(at(bar, there), below).distance, 0, 2e-5);
        EXPECT_GT(lifted->fraction, 0.1f);
    };
    expect(ground);
    expect(floor);
}

TEST(SweepRotating, WhatIsALittleInItsFloorSlidesAndTurnsOnIt) {
    // The bar is as deep as solvers leave bodies, during the whole motion.
    const Box3 box{{0, 0, 0.995f}, {1, 1, 1}};
    const auto plane = test::box_surface(Vec3(-20, -20, -1), Vec3(20, 20, 0)).mesh();
    for (const Motion3& motion :
         {Motion3{{}, {5, 1, 0}, {0, 0, std::numbers::pi_v<float>}}, Motion3{{}, {0.1f, 0, 0}, {0, 0, 0.2f}}}) {
        EXPECT_FALSE(sweep(box, motion, HalfSpace3{{0, 0, 1}, 0}));
        EXPECT_FALSE(sweep(box, motion, Box3{{0, 0, -1}, {20, 20, 1}}));
        EXPECT_FALSE(sweep(box, motion, plane));
    }
}

TEST(SweepRotating, ComesBackToWhatItWasInside) {
    // A rod overlaps a post beside its axis and makes a full revolution, first out of the post: it hits the other side.
    const Box2 rod{{1, 0}, {1, 0.05f}};
    for (const float side : {1.0f, -1.0f}) {
        const Box2 post{{1.95f, -0.12f * side}, {0.2f, 0.1f}};
        const Motion2 revolution{{}, {}, 2 * std::numbers::pi_v<float> * side};
        const auto hit = sweep(rod, revolution, post);
        ASSERT_TRUE(hit);
        EXPECT_GT(hit->fraction, 0.9f);
        EXPECT_TRUE(hit->started_inside);
        EXPECT_NEAR(closest(at(rod, pose_at(revolution, hit->fraction)), post).distance, 0, 2e-6);
    }
}

TEST(SweepRotating, ComesBackToWhatItLeft) {
    // A door that touches its frame opens, goes around, and hits the other side of the frame.
    const Box2 door{{1, 0.05f}, {1, 0.05f}};
    const Box2 frame{{1.9f, -0.1f}, {0.1f, 0.1f}};
    const auto hit = sweep(door, Motion2{{}, {}, 2 * std::numbers::pi_v<float>}, frame);
    ASSERT_TRUE(hit);
    // Its upper side, 0.1 above the hinge's line, hits the frame's lower corner near the hinge.
    EXPECT_GT(hit->fraction, 0.9f);
    EXPECT_LT(hit->fraction, 0.99f);
    const Pose2 there = pose_at(Motion2{{}, {}, 2 * std::numbers::pi_v<float>}, hit->fraction);
    EXPECT_NEAR(closest(at(door, there), frame).distance, 0, 2e-6);
}

// Shapes that are symmetric under the rotation.

TEST(SweepRotating, ABallThatSpinsGoesStraight) {
    const Sphere ball{{0, 0, 0}, 1};
    const HalfSpace3 ground{{0, 0, 1}, 0};
    EXPECT_FALSE(sweep(ball, Motion3{{{0, 0, 1}}, {6, 0, 0}, {0, 100, 0}}, ground));
    const Box3 wall{{5, 0, 0}, {1, 4, 4}};
    const auto hit = sweep(ball, Motion3{{{0, 0, 1}}, {6, 0, 0}, {0, 100, 0}}, wall);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, 0.5, 1e-5);
    const Cylinder wheel{{0, -0.2f, 0}, {0, 0.2f, 0}, 1};
    const auto rolled = sweep(wheel, Motion3{{{0, 0, 1}}, {6, 0, 0}, {0, 100, 0}}, wall);
    ASSERT_TRUE(rolled);
    EXPECT_NEAR(rolled->fraction, 0.5, 1e-5);
}

// Support functions, composites, moving half-spaces.

TEST(SweepRotating, ACylinderTipsOver) {
    // It rotates about the edge of its base onto a box as high as its radius: its wall hits the corner.
    const Cylinder column{{1, 0, 0}, {1, 0, 6}, 1};
    const HalfSpace3 ground{{0, 0, 1}, 0};
    const Motion3 over{{}, {}, {0, -0.75f * std::numbers::pi_v<float>, 0}};
    const auto hit = sweep(column, over, ground);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction, 2.0 / 3, 1e-4);
    const Box3 slab{{0, 0, -1}, {20, 20, 1}};
    const auto slab_hit = sweep(column, over, slab);
    ASSERT_TRUE(slab_hit);
    EXPECT_NEAR(slab_hit->fraction, 2.0 / 3, 1e-4);
}

TEST(SweepRotating, AHalfSpaceThatTurnsMeetsWhatStands) {
    // A ramp that rises about the origin never hits a ball of radius 1 at (0, 0, 3), because it stays beside the ball
    // until upright. A lid that falls on the ball does.
    const HalfSpace3 lid{{1, 0, 0}, 0};
    const Sphere ball{{4, 0, 2}, 1};
    const auto hit = sweep(lid, Motion3{{}, {}, {0, std::numbers::pi_v<float>, 0}}, ball);
    ASSERT_TRUE(hit);
    // The boundary passes through the origin; it hits the ball when the distance of the center is 1.
    const Pose3 there = pose_at(Motion3{{}, {}, {0, std::numbers::pi_v<float>, 0}}, hit->fraction);
    EXPECT_NEAR(closest(at(lid, there), ball).distance, 0, 1e-5);
    const auto other_way = sweep(ball, Motion3{}, lid, Motion3{{}, {}, {0, std::numbers::pi_v<float>, 0}});
    ASSERT_TRUE(other_way);
    EXPECT_NEAR(other_way->fraction, hit->fraction, 2e-6);
    EXPECT_TRUE(near(other_way->normal, -hit->normal, 1e-5));
}

TEST(SweepRotating, ARodThroughAGridOfPostsMeetsTheFirst) {
    // The posts are one mesh, or single shapes.
    test::Surface posts;
    std::vector<Box3> boxes;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            const Vec3 middle(static_cast<float>(i) * 1.5f - 3, static_cast<float>(j) * 1.5f - 3, 0);
            boxes.push_back({middle, {0.1f, 0.1f, 1}});
            posts = test::joined(posts, test::box_surface(middle - boxes[0].half, middle + boxes[0].half));
        }
    const Mesh mesh = posts.mesh();
    const Box3 rod{{0, 0, 0}, {1, 0.05f, 0.05f}};
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const Motion3 motion{{to_float(random.in_cube<3>() * 5.0), random.rotation<3>()},
                             to_float(random.in_cube<3>() * 3.0),
                             to_float(random.direction<3>() * random.uniform(0, 6))};
        const Motion3 of_mesh{{}, to_float(random.in_cube<3>() * 0.5), to_float(random.direction<3>() * 0.2)};
        std::optional<Hit<3>> first;
        bool starts_apart = true;
        for (const Box3& post : boxes) {
            starts_apart = starts_apart && closest(at(rod, motion.from), post).distance > 0.001f;
            const auto hit = sweep(rod, motion, post, of_mesh);
            if (hit && (!first || hit->fraction < first->fraction)) first = hit;
        }
        if (!starts_apart) continue;
        const auto hit = sweep(rod, motion, mesh, of_mesh);
        const auto turned_round = sweep(mesh, of_mesh, rod, motion);
        ASSERT_EQ(hit.has_value(), first.has_value());
        ASSERT_EQ(turned_round.has_value(), first.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(hit->fraction, first->fraction, 2e-5);
        EXPECT_NEAR(turned_round->fraction, first->fraction, 2e-5);
        EXPECT_LT(hit->feature.part, mesh.triangles().size());
    }
    EXPECT_GT(hits, 20);
    EXPECT_LT(hits, 80);
}

// Invariants.

TEST(SweepRotating, IsTheSameFarFromTheOrigin) {
    const Box3 rod{{0, 0, 0}, {1, 0.05f, 0.05f}};
    const Motion3 a{{{0, 0, 0}}, {0.5f, 0, 0}, {1, 2, 3}},
        b{{{1, 1, 0}, turn_about({0, 0, 1}, 1)}, {0, -0.5f, 0}, {0, 1, 0}};
    const auto hit = sweep(rod, a, rod, b);
    ASSERT_TRUE(hit);
    Motion3 far_a = a, far_b = b;
    const Vec3 away(65536, -131072, 8192);
    far_a.from.position += away;
    far_b.from.position += away;
    const auto far = sweep(rod, far_a, rod, far_b);
    ASSERT_TRUE(far);
    EXPECT_EQ(far->fraction, hit->fraction);
    EXPECT_EQ(far->normal, hit->normal);
}

TEST(SweepRotating, MeetsAtTheSameTimeWhicheverIsFirst) {
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const auto motion = [&] {
            return Motion2{{to_float(random.in_cube<2>() * 2.0), random.rotation<2>()},
                           to_float(random.in_cube<2>() * 2.0),
                           random.uniform_float(-6, 6)};
        };
        const Box2 a{{0, 0}, {1, 0.1f}}, b{{0.3f, 0}, {0.4f, 0.5f}};
        const Motion2 motion_a = motion(), motion_b = motion();
        if (closest(at(a, motion_a.from), at(b, motion_b.from)).distance < 0.001f) continue;
        const auto hit = sweep(a, motion_a, b, motion_b), other = sweep(b, motion_b, a, motion_a);
        ASSERT_EQ(hit.has_value(), other.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(hit->fraction, other->fraction, 1e-5);
        EXPECT_TRUE(near(hit->point, other->point, 1e-4));
    }
    EXPECT_GT(hits, 50);
    EXPECT_LT(hits, 250);
}

template <int D, class A, class B>
void add_sweeps(Hash& hash, const A& a, const B& b) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        oracle::Random random(seed);
        const auto pose = [&] { return Pose<D>{to_float(random.in_cube<D>() * 3.0), random.rotation<D>()}; };
        Motion<D> motion{pose(), to_float(random.in_cube<D>() * 5.0), {}};
        if constexpr (D == 2)
            motion.turn = random.uniform_float(-7, 7);
        else
            motion.turn = to_float(random.in_cube<3>() * 4.0);
        // Each number is drawn in a statement of its own, because compilers evaluate arguments in any order.
        const Pose<D> to = pose(), from = pose(), b_to = pose(), b_from = pose(), a_from = pose();
        for (const auto& hit : {sweep(a, motion, b, Motion<D>::between(from, to)),
                                sweep(a, a_from, pose_at(motion, 0.7f), b, b_from, b_to)}) {
            hash.add(std::uint64_t{hit.has_value()});
            add_hit(hash, hit);
        }
    }
}

TEST(SweepRotating, GivesTheSameBitsEverywhere) {
    Hash hash;
    add_sweeps<2>(hash, Box2{{0, 0}, {1, 0.1f}}, Box2{{0.3f, 0}, {0.4f, 0.5f}});
    add_sweeps<2>(hash, Capsule<2>{{-1, 0}, {1, 0}, 0.2f}, HalfSpace2{{0, 1}, -1});
    add_sweeps<3>(hash, Box3{{0, 0, 0}, {1, 0.1f, 0.2f}}, Box3{{0.3f, 0, 0}, {0.4f, 0.5f, 0.6f}});
    add_sweeps<3>(hash, Capsule<3>{{-1, 0, 0}, {1, 0, 0}, 0.2f}, Cylinder{{0, 0, 0}, {0, 0, 1}, 0.7f});
    add_sweeps<3>(hash, Box3{{0, 0, 0}, {0.5f, 0.1f, 0.2f}}, test::box_surface(Vec3(-1), Vec3(1)).mesh());
    EXPECT_EQ(hash.value(), 0x2c884ee2a785439du);
}

// The iteration limit: a hit reported at the limit is early.

TEST(SweepRotating, ReportsAnEarlyHitIfItGivesUp) {
    const Box3 rod{{0, 0, 0}, {1, 0.05f, 0.05f}};
    int early = 0, hits = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        oracle::Random random(seed);
        const auto path = [&](double away) {
            return rigid_path(Motion3{{to_float(random.direction<3>() * away), random.rotation<3>()},
                                      to_float(random.in_cube<3>()),
                                      to_float(random.direction<3>() * 4.0)});
        };
        const RigidPath<3> a = path(0), b = path(1.2);
        RotatingImpact<3> whole, cut;
        const bool touches = time_of_impact<3>(convex(rod), a, convex(rod), b, {}, {}, whole);
        for (const int steps : {1, 2, 3}) {
            const bool hit = time_of_impact<3>(convex(rod), a, convex(rod), b, {.max_iterations = steps}, {}, cut);
            // A hit is never missed and never late.
            ASSERT_TRUE(hit || !touches);
            if (touches) {
                EXPECT_LE(cut.time, whole.time);
            }
            early += hit && (!touches || cut.time < whole.time) ? 1 : 0;
        }
        hits += touches ? 1 : 0;
    }
    EXPECT_GT(early, 50);
    EXPECT_GT(hits, 50);
}

TEST(SweepRotating, NeedsFewSteps) {
    const Box3 rod{{0, 0, 0}, {1, 0.05f, 0.05f}};
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        oracle::Random random(seed);
        const auto motion = [&](double away) {
            return Motion3{{to_float(random.direction<3>() * away), random.rotation<3>()},
                           to_float(random.in_cube<3>()),
                           to_float(random.direction<3>() * 6.28)};
        };
        const Motion3 motion_a = motion(0), motion_b = motion(1.2);
        const RigidPath<3> a = rigid_path(motion_a), b = rigid_path(motion_b);
        RotatingImpact<3> whole, cut;
        const bool touches = time_of_impact<3>(convex(rod), a, convex(rod), b, {}, {}, whole);
        // A motion out of an overlap takes more iterations.
        const bool apart = closest(at(rod, motion_a.from), at(rod, motion_b.from)).distance > 0;
        const int steps = apart ? 40 : 200;
        ASSERT_EQ(time_of_impact<3>(convex(rod), a, convex(rod), b, {.max_iterations = steps}, {}, cut), touches);
        if (touches) {
            EXPECT_EQ(cut.time, whole.time);
        }
    }
}

// The time of impact of a half-space that left a shape deep inside without rotating was NaN.
TEST(SweepRotating, OfAHalfSpaceThatLeavesAShapeInsideIsNoHit) {
    EXPECT_FALSE(sweep(HalfSpace2{{0, 1}, 0}, Motion2{.move = {0, -1}}, Circle{{0, -3}, 1}, Motion2{}));
    EXPECT_FALSE(sweep(HalfSpace3{{0, 1, 0}, 0}, Motion3{.move = {0, -1, 0}}, Sphere{{0, -3, 0}, 1}, Motion3{}));
}

}  // namespace
}  // namespace abut
