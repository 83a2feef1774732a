// Raycasts: examples with known answers, and every kind of shape against the oracle. Along a ray, the signed distance
// of a convex shape is a convex function, so its minimum decides whether the ray hits the shape.

#include "../../oracle/check.hpp"
#include "../../oracle/expect.hpp"
#include "../../oracle/pair.hpp"
#include <abut/query/raycast.hpp>
#include <abut/shape/cylinder.hpp>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

TEST(Raycast, HitsASphereInFront) {
    const auto hit = raycast(Ray3{{-5, 0, 0}, {1, 0, 0}, 10}, Sphere{{0, 0, 0}, 2});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 3);
    EXPECT_FLOAT_EQ(hit->fraction, 0.3f);
    EXPECT_TRUE(near(hit->point, Vec3(-2, 0, 0)));
    EXPECT_TRUE(near(hit->normal, Vec3(-1, 0, 0)));
    EXPECT_FALSE(hit->started_inside);
}

TEST(Raycast, HitsAnObliqueFaceOfATurnedBox) {
    // The box is rotated by 45 degrees: a corner is at x = -sqrt(2).
    const Box2 box{{0, 0}, {1, 1}, Turn::by(0.785398163f)};
    const auto hit = raycast(Ray2{{-5, 0.5f}, {1, 0}, 10}, box);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->point.x, -std::sqrt(2.0) + 0.5, 1e-6);
    EXPECT_TRUE(near(hit->normal, Vec2(-0.70710678f, 0.70710678f)));
}

TEST(Raycast, MissesWhatIsBesideBehindOrTooFar) {
    const Sphere sphere{{0, 0, 0}, 1};
    EXPECT_FALSE(raycast(Ray3{{-5, 1.001f, 0}, {1, 0, 0}, 10}, sphere));
    EXPECT_FALSE(raycast(Ray3{{5, 0, 0}, {1, 0, 0}, 10}, sphere));
    EXPECT_FALSE(raycast(Ray3{{-5, 0, 0}, {1, 0, 0}, 3.999f}, sphere));
}

TEST(Raycast, OfInfiniteLengthHasFractionZero) {
    const auto hit = raycast(Ray3{{-5, 0, 0}, {1, 0, 0}}, Sphere{{0, 0, 0}, 1});
    ASSERT_TRUE(hit);
    EXPECT_FLOAT_EQ(hit->distance, 4);
    EXPECT_EQ(hit->fraction, 0);
}

TEST(Raycast, OfLengthZeroHitsOnlyWhatItGoesInto) {
    EXPECT_FALSE(raycast(Ray3{{-2, 0, 0}, {1, 0, 0}, 0}, Sphere{{0, 0, 0}, 1}));
    const auto hit = raycast(Ray3{{-1, 0, 0}, {1, 0, 0}, 0}, Sphere{{0, 0, 0}, 1});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->distance, 0);
}

TEST(Raycast, FromInsideHitsOnlyOnTheWayFurtherIn) {
    const Box3 box{{0, 0, 0}, {2, 2, 2}};
    const auto in = raycast(Ray3{{1.5f, 0, 0}, {-1, 0, 0}, 10}, box);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->fraction, 0);
    EXPECT_TRUE(in->started_inside);
    EXPECT_TRUE(near(in->normal, Vec3(1, 0, 0)));
    EXPECT_FALSE(raycast(Ray3{{1.5f, 0, 0}, {1, 0, 0}, 10}, box));
    EXPECT_FALSE(raycast(Ray3{{1.5f, 0, 0}, {0, 1, 0}, 10}, box));
}

TEST(Raycast, LeavesItsMirror) {
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_FALSE(raycast(Ray3{{1, 0, 0}, {0.6f, 0.8f, 0}, 10}, box));
    EXPECT_FALSE(raycast(Ray3{{1, 0, 0}, {0, 1, 0}, 10}, box));
    const auto in = raycast(Ray3{{1, 0, 0}, {-0.6f, 0.8f, 0}, 10}, box);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->fraction, 0);
    EXPECT_FALSE(in->started_inside);
    // Every direction leads out of a triangle, which has zero thickness.
    const Triangle<3> triangle{{0, -1, -1}, {0, 1, -1}, {0, 0, 2}};
    EXPECT_FALSE(raycast(Ray3{{0, 0, 0}, {1, 0, 0}, 10}, triangle));
    EXPECT_FALSE(raycast(Ray3{{0, 0, 0}, {-1, 0, 0}, 10}, triangle));
}

TEST(Raycast, HitsATriangleFromBothSides) {
    const Triangle<3> triangle{{0, -1, -1}, {0, 1, -1}, {0, 0, 2}};
    for (const float side : {-1.0f, 1.0f}) {
        const auto hit = raycast(Ray3{{side, 0, 0}, {-side, 0, 0}, 2}, triangle);
        ASSERT_TRUE(hit);
        EXPECT_FLOAT_EQ(hit->fraction, 0.5f);
        EXPECT_TRUE(near(hit->normal, Vec3(side, 0, 0)));
    }
}

TEST(Raycast, HitsTheGroundAtASlant) {
    const auto hit = raycast(Ray3{{0, 3, 0}, {0.8f, -0.6f, 0}, 100}, HalfSpace3{{0, 1, 0}, 0});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 5, 1e-5);
    EXPECT_TRUE(near(hit->point, Vec3(4, 0, 0), 1e-5));
    EXPECT_TRUE(near(hit->normal, Vec3(0, 1, 0)));
}

TEST(Raycast, HitsTheRimOfACylinderAndTheSideOfACone) {
    const auto rim = raycast(Ray3{{-5, 0.5f, 0}, {1, 0, 0}, 10}, Cylinder{{0, 0, 0}, {0, 1, 0}, 2});
    ASSERT_TRUE(rim);
    EXPECT_NEAR(rim->distance, 3, 1e-5);
    EXPECT_TRUE(near(rim->normal, Vec3(-1, 0, 0), 1e-3));
    // At half its height, a cone has half its radius.
    const auto side = raycast(Ray3{{-5, 0.5f, 0}, {1, 0, 0}, 10}, Cone{{0, 0, 0}, {0, 1, 0}, 2});
    ASSERT_TRUE(side);
    EXPECT_NEAR(side->distance, 4, 1e-5);
    EXPECT_TRUE(near(side->normal, Vec3(-0.4472136f, 0.8944272f, 0), 1e-3));
}

template <class T>
class RaycastOracle : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(RaycastOracle, Dimensions);

/// The minimum of a convex function between 0 and 1.
template <class F>
double least_between_0_and_1(F&& f) {
    double low = 0, high = 1;
    for (int step = 0; step < 60; ++step) {
        const double third = (high - low) / 3;
        if (f(low + third) < f(high - third))
            high -= third;
        else
            low += third;
    }
    return std::min({f(0), f(1), f(0.5 * (low + high))});
}

TYPED_TEST(RaycastOracle, AgreesOnEveryKindOfShape) {
    constexpr int D = TypeParam::value;
    int rays = 0, hits = 0;
    for (int kind = 0; kind < oracle::kind_count; ++kind)
        for (int i = 0; i < oracle::case_count(150); ++i) {
            SCOPED_TRACE(testing::Message() << "kind " << kind << ", seed " << i);
            oracle::Random random(static_cast<std::uint64_t>(i));
            const double size = random.power_of_two(-10, 13);
            const DVec<D> center = random.direction<D>() * (size * random.power_of_two(-4, 10));
            const auto a = oracle::SampleGenerator<D>(random, center, size).make(static_cast<oracle::Kind>(kind));
            // The ray starts around the shape and passes near its center, or near a corner.
            const DVec<D> from = center + random.direction<D>() * (size * random.uniform(0, 6));
            const auto corners = oracle::corners_relative_to(a.solid, DVec<D>(0.0));
            const DVec<D> corner = corners[random.below(static_cast<std::uint32_t>(corners.size()))];
            const DVec<D> aim = corner + (oracle::middle(a.solid) - corner) * random.uniform(-1.5, 0.9) +
                                random.direction<D>() * a.solid.radius * random.uniform(0, 1.6);
            const auto ray = Ray<D>::between(to_float(from), to_float(from + (aim - from) * random.uniform(0.7, 3)));

            const auto at = [&](double fraction) {
                return DVec<D>(ray.origin) +
                       normalized(DVec<D>(ray.direction)) * (fraction * static_cast<double>(ray.length));
            };
            const auto distance_at = [&](double fraction) {
                auto point = oracle::hull_of<D>({Vec<D>(0)});
                point.place.offset = at(fraction);
                return truth(a.solid, point, oracle::Arithmetic::floating_point).distance;
            };
            const double margin = tolerance_for(a.solid, oracle::hull_of<D>({ray.origin})) +
                                  oracle::ulp(largest(from)) * 4 + 1e-5 * oracle::size(a.solid);
            const double least = least_between_0_and_1(distance_at), start = distance_at(0);
            const auto hit = raycast(ray, a.view);
            ++rays;
            hits += hit ? 1 : 0;
            if (start > margin && least < -margin) {
                EXPECT_TRUE(hit) << "least distance " << least;
            }
            if (least > margin) {
                EXPECT_FALSE(hit) << "least distance " << least;
            }
            if (!hit) continue;
            EXPECT_TRUE(oracle::is_unit(hit->normal));
            EXPECT_LT(dot(DVec<D>(hit->normal), DVec<D>(ray.direction)), 0);
            EXPECT_EQ(hit->started_inside && start > margin, false);
            const double fraction = static_cast<double>(hit->distance) / static_cast<double>(ray.length);
            EXPECT_NEAR(hit->fraction, fraction, 1e-6);
            EXPECT_TRUE(near(hit->point, to_float(at(fraction)), margin + oracle::rounding_of(hit->point)));
            if (hit->fraction > 0) {
                EXPECT_NEAR(distance_at(fraction), 0, margin);
            }
            for (const double before : {0.25, 0.5, 0.75, 0.99})
                EXPECT_GE(distance_at(before * fraction), std::min(-margin, start - margin));
        }
    EXPECT_GT(hits, rays * 3 / 10);
    EXPECT_LT(hits, rays * 7 / 10);
}

}  // namespace
}  // namespace abut
