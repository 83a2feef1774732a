// Shapes placed, rounded and stretched.

#include "../oracle/expect.hpp"
#include "../oracle/random.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/contains.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

TEST(View, RefersToAnLvalueAndOwnsAnRvalue) {
    Circle circle{{0, 0}, 1};
    const auto refers = at(circle, Pose2{{5, 0}});
    const auto owns = at(Circle{{0, 0}, 1}, Pose2{{5, 0}});
    const auto copied = owned(refers);
    static_assert(std::is_same_v<decltype(refers), const At<Circle&>>);
    static_assert(std::is_same_v<decltype(owns), const At<Circle>>);
    static_assert(std::is_same_v<decltype(copied), const At<Circle>>);
    static_assert(std::is_same_v<decltype(owned(rounded(refers, 1))), Rounded<At<Circle>>>);
    circle.radius = 2;
    EXPECT_FLOAT_EQ(closest(refers, Vec2(0, 0)).distance, 3);
    EXPECT_FLOAT_EQ(closest(owns, Vec2(0, 0)).distance, 4);
    EXPECT_FLOAT_EQ(closest(copied, Vec2(0, 0)).distance, 4);
}

TEST(View, PlacedTwiceIsPlacedByTheProduct) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        oracle::Random random(seed);
        const Box3 box{to_float(random.in_cube<3>()), {1, 0.5f, 0.25f}, random.rotation<3>()};
        const Pose3 inner{to_float(random.in_cube<3>()), random.rotation<3>()};
        const Pose3 outer{to_float(random.in_cube<3>()), random.rotation<3>()};
        const Vec3 point = to_float(random.in_cube<3>() * 4.0);
        EXPECT_NEAR(closest(at(at(box, inner), outer), point).distance, closest(at(box, outer * inner), point).distance,
                    2e-6);
        EXPECT_NEAR(closest(at(at(box, inner), inverse(inner)), point).distance, closest(box, point).distance, 2e-6);
    }
}

TEST(View, OfABoxStretchedIsALongerBox) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        oracle::Random random(seed);
        const Vec3 half(1, 0.5f, 0.25f), scale = to_float(random.in_cube<3>() * 3.0);
        const auto longer = stretched(Box3{{1, 2, 3}, half}, scale);
        const Box3 same{Vec3(1, 2, 3) * scale,
                        Vec3(std::abs(half.x * scale.x), std::abs(half.y * scale.y), std::abs(half.z * scale.z))};
        const Triangle<3> triangle{to_float(random.in_cube<3>() * 5.0), to_float(random.in_cube<3>() * 5.0),
                                   to_float(random.in_cube<3>() * 5.0)};
        EXPECT_NEAR(closest(longer, triangle).distance, closest(same, triangle).distance, 1e-5);
        EXPECT_TRUE(near(bounds(longer).min, bounds(view(same)).min, 1e-6));
        EXPECT_TRUE(near(bounds(longer).max, bounds(view(same)).max, 1e-6));
    }
}

TEST(View, OfABallStretchedIsAnEllipse) {
    const auto ellipse = stretched(Circle{{0, 0}, 1}, Vec2(3, 1));
    int inside = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const Vec2 point = to_float(random.in_cube<2>() * DVec<2>(4, 1.5));
        // Every thousandth of the circle, by its rational parametrisation.
        double least = std::numeric_limits<double>::infinity();
        for (int i = -2000; i <= 2000; ++i) {
            const double t = static_cast<double>(i) / 2000, x = (1 - t * t) / (1 + t * t), y = 2 * t / (1 + t * t);
            for (const double side : {-1.0, 1.0})
                least = std::min(least, length(DVec<2>(3 * side * x, y) - DVec<2>(point)));
        }
        const bool within = point.x * point.x / 9 + point.y * point.y <= 1;
        inside += within ? 1 : 0;
        // The samples are up to 1.5e-3 from the nearest point, along the border; the depth may be 3e-3 above the least.
        EXPECT_NEAR(closest(ellipse, point).distance, within ? -least : least, 4e-3);
        if (least > 1e-3) {
            EXPECT_EQ(contains(ellipse, point), within);
        }
    }
    EXPECT_GT(inside, 90);
    EXPECT_LT(inside, 210);
}

TEST(View, OfACapsuleStretchedIsItsSegmentWithAnEllipse) {
    // A capsule along x, pressed flat to a quarter of its height.
    const auto flat = stretched(Capsule<3>{{-1, 0, 0}, {1, 0, 0}, 1}, Vec3(1, 0.25f, 1));
    EXPECT_NEAR(closest(flat, Vec3(0, 1, 0)).distance, 0.75, 1e-5);
    EXPECT_NEAR(closest(flat, Vec3(3, 0, 0)).distance, 1, 1e-5);
    EXPECT_NEAR(closest(flat, Vec3(0, 0, 2)).distance, 1, 1e-5);
    EXPECT_TRUE(near(bounds(flat).max, Vec3(2, 0.25f, 1), 1e-6));
}

TEST(View, StretchedByOneFactorStaysRound) {
    const auto half = stretched(rounded(Box3{{1, 0, 0}, {0.5f, 0.5f, 0.5f}}, 1), Vec3(0.5f));
    EXPECT_NEAR(closest(half, Vec3(3, 0, 0)).distance, 1.75, 1e-6);
    const auto mirrored = stretched(rounded(Box3{{1, 0, 0}, {0.5f, 0.5f, 0.5f}}, 1), Vec3(-1, 1, 1));
    EXPECT_NEAR(closest(mirrored, Vec3(-4, 0, 0)).distance, 1.5, 1e-6);
}

TEST(View, StretchedByZeroIsFlat) {
    const auto shadow = stretched(Box3{{0, 5, 0}, {1, 1, 1}}, Vec3(1, 0, 1));
    EXPECT_NEAR(closest(shadow, Vec3(0, 2, 0)).distance, 2, 1e-6);
    EXPECT_TRUE(contains(shadow, Vec3(0.5f, 0, 0.5f)));
    const auto disc = stretched(Sphere{{0, 0, 0}, 2}, Vec3(1, 0, 1));
    EXPECT_NEAR(closest(disc, Vec3(0, 3, 0)).distance, 3, 1e-5);
    EXPECT_NEAR(closest(disc, Vec3(5, 0, 0)).distance, 3, 1e-5);
}

TEST(View, RoundedAddsUp) {
    const auto twice = rounded(rounded(Segment<2>{{0, 0}, {4, 0}}, 0.5f), 0.25f);
    EXPECT_FLOAT_EQ(closest(twice, Vec2(2, 2)).distance, 1.25f);
    EXPECT_FLOAT_EQ(closest(rounded(HalfSpace2{{0, 1}, 0}, 0.5f), Vec2(7, 2)).distance, 1.5f);
}

TEST(View, OfAHalfSpaceMovesItsBorder) {
    const HalfSpace3 ground{{0, 1, 0}, 1};
    EXPECT_FLOAT_EQ(closest(at(ground, Pose3{{5, 2, 5}}), Vec3(0, 10, 0)).distance, 7);
    EXPECT_FLOAT_EQ(closest(stretched(ground, Vec3(7, 3, 7)), Vec3(0, 10, 0)).distance, 7);
    // Rotated by a quarter about z, +y becomes -x.
    const Pose3 quarter{{0, 0, 0}, turn_about({0, 0, 1}, 1.57079633f)};
    EXPECT_NEAR(closest(at(ground, quarter), Vec3(-10, 0, 0)).distance, 9, 1e-5);
    // x + y <= 1 stretched by two along x is x / 2 + y <= 1.
    const auto wide = stretched(HalfSpace2{Vec2(1, 1) * 0.70710678f, 0.70710678f}, Vec2(2, 1));
    EXPECT_NEAR(closest(wide, Vec2(2, 0)).distance, 0, 1e-6);
    EXPECT_NEAR(closest(wide, Vec2(0, 1)).distance, 0, 1e-6);
}

TEST(View, OfAViewIsAShapeToo) {
    const Box2 box{{0, 0}, {1, 1}};
    const Convex<2> as_convex = convex(box);
    const View<2> as_view = view(box);
    EXPECT_FLOAT_EQ(closest(at(as_convex, Pose2{{5, 0}}), Vec2(0, 0)).distance, 4);
    EXPECT_FLOAT_EQ(closest(at(as_view, Pose2{{5, 0}}), Vec2(0, 0)).distance, 4);
    EXPECT_FLOAT_EQ(closest(rounded(as_view, 1.0f), Vec2(5, 0)).distance, 3);
    EXPECT_FLOAT_EQ(closest(stretched(as_view, Vec2(2, 1)), Vec2(5, 0)).distance, 3);
    EXPECT_FLOAT_EQ(closest(as_view, as_convex).distance, -2);
}

}  // namespace
}  // namespace abut
