// The closed-form sweeps of plain shapes in 2D agree with the sweeps of their views, except for rounding and answers
// within the tolerance.

#include "../../oracle/expect.hpp"
#include "../../oracle/pair.hpp"
#include "../../oracle/random.hpp"
#include "../drawn_shapes.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/sweep.hpp>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace abut {
namespace {

using oracle::near;
using oracle::Random;

/// The numbers of answers of each kind.
struct Counts {
    int pairs = 0, hits = 0, direct = 0, grazing = 0, alike = 0;
};

/// The distance of the shapes after their motions.
template <class A, class B>
float distance_at(const A& a, const Vec2& moved_a, const B& b, const Vec2& moved_b) {
    return closest(at(a, Pose2{moved_a}), at(b, Pose2{moved_b})).distance;
}

template <class A, class B>
void compare(const A& a, const Vec2& motion_a, const B& b, const Vec2& motion_b, double tolerance, Counts& counts) {
    const View<2> view_a(view(a)), view_b(view(b));
    const auto direct = sweep(a, motion_a, b, motion_b), of_views = sweep(view_a, motion_a, view_b, motion_b);
    ++counts.pairs;
    std::optional<Hit<2>> ignored;
    if (closed_form_sweep(shape_ref(a), motion_a, shape_ref(b), motion_b, ignored) != detail::PairAnswer::unknown)
        ++counts.direct;
    const double length = static_cast<double>(glm::length(motion_a - motion_b));
    if (direct.has_value() != of_views.has_value()) {
        // Only one of them reports a touch within the tolerance as a hit.
        ++counts.grazing;
        const float fraction = (direct ? direct : of_views)->fraction;
        EXPECT_NEAR(distance_at(a, motion_a * fraction, b, motion_b * fraction), 0, tolerance);
        return;
    }
    if (!direct) return;
    ++counts.hits;
    const double closing = -static_cast<double>(glm::dot(of_views->normal, motion_a - motion_b)) / length;
    EXPECT_NEAR(direct->distance, of_views->distance, tolerance / std::max(closing, 0.01));
    EXPECT_NEAR(direct->fraction, direct->distance / length, 1e-6);
    EXPECT_EQ(direct->started_inside, of_views->started_inside);
    // A corner against a corner has several valid normals and features.
    if (direct->feature == of_views->feature && near(direct->normal, of_views->normal, 1e-3)) ++counts.alike;
    EXPECT_NEAR(glm::length(direct->normal), 1, 1e-6);
    // Face to face, every point on both shapes is valid. Deep overlaps have no such point.
    if (direct->started_inside) return;
    const Vec2 now_a = motion_a * direct->fraction, now_b = motion_b * direct->fraction;
    EXPECT_NEAR(closest(at(a, Pose2{now_a}), direct->point).distance, 0, tolerance);
    EXPECT_NEAR(closest(at(b, Pose2{now_b}), direct->point).distance, 0, tolerance);
}

/// Motions by which about half of the pairs touch, some along an axis and some of length 0.
struct DrawnMotion {
    Vec2 from, motion_a, motion_b;

    DrawnMotion(Random& random, DrawnShapes<2>& shapes) {
        from = shapes.point(random.chance(0.1) ? 2 : 6);
        Vec2 displacement = shapes.point(2) - from;
        if (shapes.on_grid() && random.chance(0.5)) displacement[static_cast<int>(random.below(2))] = 0;
        const float stretch =
            shapes.on_grid() ? 0.5f * static_cast<float>(random.below(5)) : random.uniform_float(0, 2);
        motion_b = random.chance(0.5) ? Vec2(0) : shapes.point(3);
        motion_a = displacement * stretch + motion_b;
    }
};

/// The tolerance, with rounding to floats, of pairs of size 1 at most 8 from the origin.
constexpr double pair_tolerance = 5e-5;

TEST(DirectSweep, AnswersAreThoseOfTheViews) {
    Counts counts;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(20000)); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        DrawnShapes<2> shapes(random);
        const DrawnMotion motion(random, shapes);
        shapes.draw(
            [&](const auto& a) {
                shapes.draw(
                    [&](const auto& b) { compare(a, motion.motion_a, b, motion.motion_b, pair_tolerance, counts); });
            },
            motion.from);
        if (HasFailure()) return;
    }
    RecordProperty("direct", counts.direct);
    RecordProperty("grazing", counts.grazing);
    RecordProperty("alike", counts.alike);
    RecordProperty("hits", counts.hits);
    EXPECT_GT(counts.hits, counts.pairs * 3 / 10);
    EXPECT_LT(counts.hits, counts.pairs * 7 / 10);
    EXPECT_GT(counts.direct, counts.pairs * 3 / 4);
    EXPECT_LT(counts.grazing, counts.pairs / 100);
    EXPECT_GT(counts.alike, counts.hits * 9 / 10);
}

/// Expects a hit with a closed form.
template <class A, class B>
std::optional<Hit<2>> direct_hit(const A& a, const Vec2& motion, const B& b) {
    std::optional<Hit<2>> result;
    EXPECT_EQ(closed_form_sweep(shape_ref(a), motion, shape_ref(b), Vec2(0), result), detail::PairAnswer::yes);
    return result;
}

TEST(DirectSweep, FaceToFaceHasAClosedForm) {
    // The nearest corners lie beyond the other shape's sides.
    const Box2 wide{{0, 5}, {3, 1}}, narrow{{0, 0}, {1, 1}}, beside{{2, 0}, {1.5f, 1}};
    for (const auto& [a, b] : {std::pair(wide, narrow), std::pair(wide, beside)}) {
        const auto down = direct_hit(a, Vec2(0, -6), b), up = direct_hit(b, Vec2(0, 6), a);
        ASSERT_TRUE(down && up);
        EXPECT_FLOAT_EQ(down->fraction, 0.5f);
        EXPECT_FLOAT_EQ(up->fraction, 0.5f);
        EXPECT_TRUE(near(down->normal, Vec2(0, 1)));
        EXPECT_TRUE(near(up->normal, Vec2(0, -1)));
        EXPECT_FLOAT_EQ(down->point.y, 1);
        EXPECT_FLOAT_EQ(up->point.y, 4);
        EXPECT_LE(std::abs(down->point.x - b.center.x), b.half.x);
        EXPECT_LE(std::abs(down->point.x), a.half.x);
    }
    const Polygon square = *Polygon::build(std::vector<Vec2>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
    const auto hit = direct_hit(at(square, Pose2{{0.5f, 5}}), Vec2(0, -6), square);
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->fraction, 0.5f);
    EXPECT_FLOAT_EQ(hit->point.y, 1);
    const auto stick = direct_hit(Capsule2{{-3, 5}, {3, 5}, 0.5f}, Vec2(0, -7), narrow);
    ASSERT_TRUE(stick);
    EXPECT_FLOAT_EQ(stick->fraction, 0.5f);
    EXPECT_TRUE(near(stick->normal, Vec2(0, 1)));
    EXPECT_FLOAT_EQ(stick->point.y, 1);
}

TEST(DirectSweep, RoundAboutACornerHasAClosedForm) {
    // 3, 4, 5: the circle's center stops over the corner (1, 1) at (1 + 3, 1 + 4).
    const Circle circle{{4, 15}, 5};
    const Box2 box{{0, 0}, {1, 1}};
    for (const bool circle_moves : {true, false}) {
        const auto hit = circle_moves ? direct_hit(circle, Vec2(0, -20), box) : direct_hit(box, Vec2(0, 20), circle);
        ASSERT_TRUE(hit);
        EXPECT_FLOAT_EQ(hit->fraction, 0.5f);
        EXPECT_TRUE(near(hit->normal, Vec2(0.6f, 0.8f) * (circle_moves ? 1.0f : -1.0f)));
        EXPECT_TRUE(near(hit->point, circle_moves ? Vec2(1, 1) : Vec2(1, 11)));
        EXPECT_EQ(hit->feature.kind, FeatureKind::vertex);
        EXPECT_EQ(hit->feature.index, 0u);
    }
    const auto end = direct_hit(Capsule2{{-9, 0}, {-5, 0}, 1}, Vec2(8, 0), Capsule2{{0, 0}, {4, 0}, 1});
    ASSERT_TRUE(end);
    EXPECT_FLOAT_EQ(end->distance, 3);
    EXPECT_TRUE(near(end->point, Vec2(-1, 0)));
}

TEST(DirectSweep, OfWhatRestsOnAFloorIsNoHitButOfAWallIs) {
    const Box2 floor{{0, -1}, {50, 1}}, crate{{0, 0.5f}, {0.5f, 0.5f}}, wall{{9, 1}, {0.5f, 1}};
    for (const float lift : {0.0f, 1e-6f, -1e-6f}) {
        const Box2 lifted{crate.center + Vec2(0, lift), crate.half};
        EXPECT_FALSE(sweep(lifted, Vec2(20, 0), floor)) << lift;
        EXPECT_FALSE(sweep(lifted, Vec2(20, 1), floor)) << lift;
        EXPECT_TRUE(sweep(lifted, Vec2(20, -1), floor)) << lift;
        const auto hit = direct_hit(lifted, Vec2(20, 0), wall);
        ASSERT_TRUE(hit);
        EXPECT_FLOAT_EQ(hit->distance, 8);
    }
    const auto ball = sweep(Circle{{0, 0.5f}, 0.5f}, Vec2(20, 0), floor);
    EXPECT_FALSE(ball);
}

TEST(DirectSweep, SlidesOverTheSeamsOfAFloor) {
    const Polygon block =
        *Polygon::build(std::vector<Vec2>{{-0.5f, -0.5f}, {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}});
    for (const float lift : {0.0f, 1e-6f, -1e-6f}) {
        const Vec2 middle(0, 0.5f + lift);
        for (float x = 2; x < 9; x += 2) {
            const Box2 tile{{x, -1}, {1, 1}};
            EXPECT_FALSE(sweep(Box2{middle, {0.5f, 0.5f}}, Vec2(20, 0), tile)) << lift;
            EXPECT_FALSE(sweep(at(block, Pose2{middle}), Vec2(20, 0), tile)) << lift;
            EXPECT_FALSE(sweep(Circle{middle, 0.5f}, Vec2(20, 0), tile)) << lift;
        }
    }
    // A motion of length 0 has no hit.
    EXPECT_TRUE(sweep(Box2{{0, 0.49f}, {0.5f, 0.5f}}, Vec2(20, 0), Box2{{2, -1}, {1, 1}}));
    EXPECT_TRUE(sweep(Circle{{0, 0.49f}, 0.5f}, Vec2(20, 0), Box2{{2, -1}, {1, 1}}));
}

TEST(DirectSweep, OfWhatIsFastAndThinDoesntTunnel) {
    const Box2 wall{{1.25f, 0}, {5e-4f, 4}};
    const Segment2 line{{1.25f, -9}, {1.25f, 9}};
    const Polygon slug = *Polygon::build(std::vector<Vec2>{{-0.5f, -0.1f}, {0.5f, -0.1f}, {0.5f, 0.1f}});
    for (const float length : {5e3f, 1e8f, 1e30f}) {
        const auto circle = sweep(Circle{{-3000, 0.2f}, 0.5f}, Vec2(length, 0), wall);
        ASSERT_TRUE(circle);
        EXPECT_NEAR(circle->distance, 3000.7495, 1e-3);
        const auto box = sweep(Box2{{-3000, 0.2f}, {0.5f, 0.1f}}, Vec2(length, 0), wall);
        ASSERT_TRUE(box);
        EXPECT_NEAR(box->distance, 3000.7495, 1e-3);
        const auto polygon = sweep(at(slug, Pose2{{-3000, 0.2f}}), Vec2(length, 0), line);
        ASSERT_TRUE(polygon);
        EXPECT_NEAR(polygon->distance, 3000.75, 1e-3);
        EXPECT_FALSE(sweep(Box2{{-3000, 0.2f}, {0.5f, 0.1f}}, Vec2(-length, 0), wall));
        EXPECT_FALSE(sweep(Circle{{-3000, 4.6f}, 0.5f}, Vec2(length, 0), wall));
    }
}

TEST(DirectSweep, OfNoMotionIsNoHit) {
    const Box2 box{{0, 0}, {1, 1}}, other{{1, 1}, {1, 1}};
    EXPECT_FALSE(sweep(box, Vec2(0, 0), other));
    EXPECT_FALSE(sweep(box, Vec2(3, 1), other, Vec2(3, 1)));
    EXPECT_FALSE(sweep(Circle{{0, 0}, 1}, Vec2(0, 0), Circle{{2, 0}, 1}));
}

}  // namespace
}  // namespace abut
