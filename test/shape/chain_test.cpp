#include "../oracle/expect.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/placed.hpp>

#include <limits>

namespace abut {
namespace {

using oracle::near;

/// A square from 0 to 2, counter-clockwise.
Chain square(const ChainOptions& options = {}) {
    return *Chain::build({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, true, options);
}

TEST(Chain, TellsWhatIsWrongAndWhere) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto problem = [](std::initializer_list<Vec2> points, bool closed) {
        const Result<Chain> built = Chain::build(points, closed);
        EXPECT_FALSE(built);
        return built ? Problem{} : built.problem();
    };
    EXPECT_EQ(problem({}, false).code, ProblemCode::empty_input);
    EXPECT_EQ(problem({{0, 0}}, false).code, ProblemCode::empty_input);
    EXPECT_EQ(problem({{0, 0}, {1, 0}}, true).code, ProblemCode::empty_input);
    const Problem not_finite = problem({{0, 0}, {1, 0}, {nan, 0}}, false);
    EXPECT_EQ(not_finite.code, ProblemCode::not_finite);
    EXPECT_EQ(not_finite.index, 2u);
    const Problem flat = problem({{0, 0}, {1, 0}, {1, 0}}, false);
    EXPECT_EQ(flat.code, ProblemCode::degenerate);
    EXPECT_EQ(flat.index, 1u);
    // The last point of a closed chain is not the first one again.
    EXPECT_EQ(problem({{0, 0}, {1, 0}, {1, 1}, {0, 0}}, true).index, 3u);
}

TEST(Chain, KnowsItsSegmentsAndTheirNeighbours) {
    const Chain closed = square();
    ASSERT_EQ(closed.size(), 4u);
    EXPECT_TRUE(near(closed.segment(3).a, Vec2(0, 2)));
    EXPECT_TRUE(near(closed.segment(3).b, Vec2(0, 0)));
    EXPECT_EQ(closed.neighbour(0, 0), 3u);
    EXPECT_EQ(closed.neighbour(3, 1), 0u);
    EXPECT_EQ(view(closed).neighbour(&closed, 1, 1), 2u);
    const Chain open = *Chain::build({{0, 0}, {1, 0}, {2, 1}}, false);
    ASSERT_EQ(open.size(), 2u);
    EXPECT_EQ(open.neighbour(0, 0), no_neighbour);
    EXPECT_EQ(open.neighbour(0, 1), 1u);
    EXPECT_EQ(open.neighbour(1, 1), no_neighbour);
    EXPECT_EQ(bounds(open).max, Vec2(2, 1));
}

TEST(Chain, IsSolidInContainsWhereItIsClosed) {
    EXPECT_TRUE(contains(square(), Vec2(1, 1)));
    EXPECT_TRUE(contains(square(), Vec2(2, 1)));
    EXPECT_FALSE(contains(square(), Vec2(3, 1)));
    EXPECT_FALSE(contains(square(), Vec2(1, -0.5f)));
    // Rays at the height of corners, and through them.
    EXPECT_FALSE(contains(square(), Vec2(-1, 0)));
    EXPECT_FALSE(contains(square(), Vec2(-1, 2)));
    const Chain open = *Chain::build({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, false);
    EXPECT_FALSE(contains(open, Vec2(1, 1)));
    EXPECT_TRUE(contains(open, Vec2(1, 0)));
    // A loop that winds twice contains its inside; a figure of eight is solid in both loops.
    const Chain eight = *Chain::build({{-2, -1}, {2, 1}, {2, -1}, {-2, 1}}, true);
    EXPECT_TRUE(contains(eight, Vec2(-1.5f, 0)));
    EXPECT_TRUE(contains(eight, Vec2(1.5f, 0)));
    EXPECT_FALSE(contains(eight, Vec2(0, 0.5f)));
    EXPECT_TRUE(contains(at(square(), Pose2{{10, 0}}), Vec2(11, 1)));
}

TEST(Chain, TellsTheSegment) {
    const Circle beside{{3, 1}, 0.5f};
    EXPECT_EQ(closest(square(), beside).feature_a.part, 1u);
    EXPECT_FLOAT_EQ(closest(square(), beside).distance, 0.5f);
    // A chain has no thickness: a shape within the loop is apart.
    EXPECT_FALSE(overlaps(square(), Circle{{1, 1}, 0.5f}));
    const auto hit = raycast(Ray2::between({1, 1}, {1, 5}), square());
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->feature.part, 2u);
    EXPECT_FLOAT_EQ(hit->distance, 1);
}

TEST(Chain, OneSidedIsMetFromItsFrontAlone) {
    const Chain chain = square({.one_sided = true});
    EXPECT_FALSE(raycast(Ray2::between({1, 1}, {1, 5}), chain));
    const auto into = raycast(Ray2::between({1, 5}, {1, -5}), chain);
    ASSERT_TRUE(into);
    EXPECT_FLOAT_EQ(into->distance, 3);
    EXPECT_EQ(into->feature.part, 2u);
    const Circle ball{{1, 1}, 0.25f};
    EXPECT_FALSE(sweep(ball, Vec2(5, 0), chain));
    const auto hit = sweep(Circle{{1, 4}, 0.25f}, Vec2(0, -6), chain);
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 1.75f);
    EXPECT_FLOAT_EQ(hit->normal.y, 1);
    // The reverse: the chain moves.
    EXPECT_TRUE(sweep(chain, Vec2(0, 6), Circle{{1, 4}, 0.25f}));
    EXPECT_FALSE(sweep(chain, Vec2(0, -6), ball));
    // If a shape is mostly behind the chain, the separating direction would point inwards.
    EXPECT_FALSE(contact(chain, Circle{{1, 1.9f}, 0.25f}));
    const Contact<2> touch = contact(chain, Circle{{1, 2.1f}, 0.25f});
    ASSERT_TRUE(touch);
    EXPECT_FLOAT_EQ(touch.normal.y, 1);
    EXPECT_NEAR(touch.depth, 0.15, 1e-6);
    EXPECT_FALSE(contact(Circle{{1, 1.9f}, 0.25f}, chain));
    // overlaps and closest ignore which side is the front.
    EXPECT_TRUE(overlaps(chain, Circle{{1, 1.9f}, 0.25f}));
    EXPECT_NEAR(closest(chain, Vec2(1, 1.5f)).distance, 0.5, 1e-6);
}

/// At the end of a chain: a motion along it, or towards its front but below it, doesn't hit.
TEST(Chain, OneSidedIsPassedAtItsEnds) {
    const Chain platform = *Chain::build({{1, 0}, {-1, 0}}, false, {.one_sided = true});
    EXPECT_FALSE(sweep(Circle{{-3, 0.1f}, 0.25f}, Vec2(6, 0), platform));
    EXPECT_TRUE(sweep(Circle{{-3, 0.1f}, 0.25f}, Vec2(6, -0.05f), platform));
    EXPECT_FALSE(sweep(Circle{{-3, -0.05f}, 0.25f}, Vec2(6, -0.05f), platform));
    const Chain both = *Chain::build({{1, 0}, {-1, 0}}, false);
    EXPECT_TRUE(sweep(Circle{{-3, -0.05f}, 0.25f}, Vec2(6, -0.05f), both));
}

TEST(Chain, OneSidedKeepsItsFrontWhereItIsMirroredOrTurned) {
    const Chain chain = square({.one_sided = true});
    const auto mirrored = stretched(chain, Vec2(-1, 1));
    EXPECT_FALSE(raycast(Ray2::between({-1, 1}, {-1, 5}), mirrored));
    EXPECT_TRUE(raycast(Ray2::between({-1, 5}, {-1, 1}), mirrored));
    const auto turned = at(chain, Pose2{{0, 0}, Turn{0, 1}});  // a quarter: from -2 to 0 along x
    EXPECT_FALSE(raycast(Ray2::between({-1, 1}, {-5, 1}), turned));
    EXPECT_TRUE(raycast(Ray2::between({-5, 1}, {-1, 1}), turned));
    // Rotates by pi about its lower left corner, up and over the obstacle.
    const Box2 box{{-1, -1}, {0.25f, 0.25f}};
    EXPECT_TRUE(sweep(chain, Pose2{}, Pose2{{0, 0}, Turn{0, 1}}, Box2{{-1, 1}, {0.25f, 0.25f}}, Pose2{}, Pose2{}));
    EXPECT_FALSE(sweep(chain, Pose2{}, Pose2{{0, 0}, Turn{0, 1}}, box, Pose2{}, Pose2{}));
    EXPECT_FALSE(sweep(Circle{{1, 1}, 0.25f}, Pose2{}, Pose2{{5, 0}, Turn{0, 1}}, chain, Pose2{}, Pose2{}));
}

}  // namespace
}  // namespace abut
