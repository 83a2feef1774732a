// The primitive shapes: bounds, sizes and supports, with known answers and against each other.

#include "../oracle/expect.hpp"
#include "../oracle/pair.hpp"
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

template <int D>
testing::AssertionResult is_box(const Aabb<D>& box, const Vec<D>& min, const Vec<D>& max) {
    const auto low = near(box.min, min);
    return low ? near(box.max, max) : low;
}

TEST(Primitive, BoundsAreTheLeastBox) {
    EXPECT_TRUE(is_box<2>(bounds(convex(Circle{{1, 2}, 3})), {-2, -1}, {4, 5}));
    EXPECT_TRUE(is_box<3>(bounds(convex(Capsule<3>{{0, 0, 0}, {4, 2, 0}, 1})), {-1, -1, -1}, {5, 3, 1}));
    EXPECT_TRUE(is_box<2>(bounds(convex(Segment<2>{{3, 0}, {1, 5}})), {1, 0}, {3, 5}));
    EXPECT_TRUE(is_box<3>(bounds(convex(Triangle<3>{{0, 0, 1}, {2, 0, 0}, {0, 3, 0}})), {0, 0, 0}, {2, 3, 1}));
    const Turn eighth = Turn::by(0.785398163f);
    EXPECT_TRUE(is_box<2>(bounds(convex(Box2{{1, 1}, {1, 1}, eighth})), Vec2(1 - 1.41421356f), Vec2(1 + 1.41421356f)));
    EXPECT_TRUE(is_box<3>(bounds(convex(Aabb3{{0, 1, 2}, {3, 4, 5}})), {0, 1, 2}, {3, 4, 5}));
    EXPECT_TRUE(is_box<3>(bounds(convex(Cylinder{{0, 0, 0}, {0, 4, 0}, 2})), {-2, 0, -2}, {2, 4, 2}));
    EXPECT_TRUE(is_box<3>(bounds(convex(Cone{{0, 0, 0}, {0, 4, 0}, 2})), {-2, 0, -2}, {2, 4, 2}));
    // Its axis along (3, 4, 0) / 5, a disc reaches 2 x 4 / 5 to either side.
    EXPECT_TRUE(is_box<3>(bounds(convex(Cone{{0, 0, 0}, {3, 4, 0}, 2})), {-1.6f, -1.2f, -2}, {3, 4, 2}));
}

TEST(Primitive, BoundsOfViewsAndHalfSpaces) {
    EXPECT_TRUE(is_box<2>(bounds(at(Circle{{1, 0}, 1}, Pose2{{5, 5}, Turn{0, 1}})), {4, 5}, {6, 7}));
    EXPECT_TRUE(is_box<2>(bounds(rounded(Box2{{0, 0}, {1, 2}}, 0.5f)), {-1.5f, -2.5f}, {1.5f, 2.5f}));
    EXPECT_TRUE(is_box<2>(bounds(stretched(Circle{{1, 1}, 1}, Vec2(2, -1))), {0, -2}, {4, 0}));
    const Aabb3 ground = bounds(HalfSpace3{{0, 1, 0}, 2});
    EXPECT_EQ(ground.min, Vec3(-std::numeric_limits<float>::infinity()));
    EXPECT_NEAR(ground.max.y, 2, 1e-6);
    EXPECT_GE(ground.max.y, 2);
    EXPECT_EQ(ground.max.x, std::numeric_limits<float>::infinity());
    const Aabb3 wall = bounds(HalfSpace3{{-1, 0, 0}, 3});
    EXPECT_NEAR(wall.min.x, -3, 1e-6);
    EXPECT_LE(wall.min.x, -3);
    EXPECT_EQ(wall.max, Vec3(std::numeric_limits<float>::infinity()));
}

TEST(Primitive, SizeIsTheBoundingRadius) {
    EXPECT_DOUBLE_EQ(size(convex(Sphere{{7, 8, 9}, 2})), 2);
    EXPECT_DOUBLE_EQ(size(convex(Box2{{7, 8}, {3, 4}})), 5);
    EXPECT_DOUBLE_EQ(size(convex(Capsule<2>{{0, 0}, {6, 8}, 1})), 6);
    EXPECT_DOUBLE_EQ(size(convex(Sphere{{1, 1, 1}, 0})), 0);
}

TEST(Primitive, DiscsWithoutAnAxisFaceAlongZ) {
    const Convex<3> disc = convex(Cylinder{{1, 1, 1}, {1, 1, 1}, 2});
    EXPECT_TRUE(is_box<3>(bounds(disc), {-1, -1, 1}, {3, 3, 1}));
}

template <class T>
class Support : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Support, Dimensions);

TYPED_TEST(Support, IsTheFarthestPointOfEveryKind) {
    constexpr int D = TypeParam::value;
    for (int kind = 0; kind < oracle::kind_count; ++kind)
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            SCOPED_TRACE(testing::Message() << "kind " << kind << ", seed " << seed);
            oracle::Random random(seed);
            const double size = random.power_of_two(-10, 13);
            const DVec<D> center = random.direction<D>() * size;
            const auto sample = oracle::SampleGenerator<D>(random, center, size).make(static_cast<oracle::Kind>(kind));
            const auto& shape = std::get<Convex<D>>(sample.view);
            const double tolerance = 4e-7 * size * D;
            for (int i = 0; i < 20; ++i) {
                const DVec<D> n = random.direction<D>();
                double farthest = -std::numeric_limits<double>::infinity();
                for (const DVec<D>& corner : oracle::corners_relative_to(sample.solid, DVec<D>(0.0)))
                    farthest = std::max(farthest, dot(n, corner) + sample.solid.radius);
                EXPECT_NEAR(dot(n, support(shape, n * 3.0)), farthest, tolerance);
            }
            const Aabb<D> box = bounds(sample.view);
            for (int i = 0; i < D; ++i) {
                double low = std::numeric_limits<double>::infinity(), high = -low;
                for (const DVec<D>& corner : oracle::corners_relative_to(sample.solid, DVec<D>(0.0))) {
                    low = std::min(low, corner[i] - sample.solid.radius);
                    high = std::max(high, corner[i] + sample.solid.radius);
                }
                EXPECT_NEAR(box.min[i], low, tolerance);
                EXPECT_NEAR(box.max[i], high, tolerance);
            }
            EXPECT_GE(detail::size(shape), oracle::size(sample.solid) - tolerance);
            EXPECT_LE(detail::size(shape), std::sqrt(D) * oracle::size(sample.solid) + tolerance);
        }
}

}  // namespace
}  // namespace abut
