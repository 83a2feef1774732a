// A box against a triangle: the separating axis test against the general GJK and EPA; and the closest point on a
// triangle against its distance.

#include "../oracle/random.hpp"
#include <abut/convex/pairs/box_triangle.hpp>
#include <abut/query/detail/surface/closest_points.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/triangle.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

/// The position of the triangle relative to the box.
enum class TriangleFamily { any, flush, corners_on_a_grid, sliver, large_triangle };
constexpr int family_count = 5;

struct BoxAndTriangle {
    Box3 box;
    Triangle3 triangle;
    double size;  ///< of the smaller
};

float whole(Random& random) {
    return 0.25f * static_cast<float>(static_cast<int>(random.below(17)) - 8);
}

BoxAndTriangle random_pair(Random& random, TriangleFamily family) {
    const double size = random.power_of_two(-8, 9);
    const double reach = family == TriangleFamily::large_triangle ? 64 * size : size * random.power_of_two(-1, 1);
    BoxAndTriangle pair{{Vec3(0), Vec3(0), random.rotation<3>()}, {}, 0};
    for (int i = 0; i < 3; ++i) pair.box.half[i] = static_cast<float>(size * random.uniform(0.2, 1));
    const auto corner = [&] { return to_float(random.in_cube<3>() * reach); };
    pair.triangle = {corner(), corner(), corner()};
    const Vec3 aside = to_float(random.in_cube<3>() * (0.7 * size));
    for (Vec3* point : {&pair.triangle.a, &pair.triangle.b, &pair.triangle.c}) *point += aside;
    if (family == TriangleFamily::large_triangle) {
        // Through the box, or nearly.
        const Vec3 middle = (pair.triangle.a + pair.triangle.b + pair.triangle.c) / 3.0f;
        for (Vec3* point : {&pair.triangle.a, &pair.triangle.b, &pair.triangle.c}) *point += aside - middle;
    }
    if (family == TriangleFamily::flush || family == TriangleFamily::corners_on_a_grid)
        pair.box.rotation = no_rotation<3>;
    if (family == TriangleFamily::flush) {
        // A floor with edges parallel to those of the box.
        const float height = random.chance(0.5) ? -pair.box.half.y : random.uniform_float(-0.5, 0.2) * pair.box.half.y;
        pair.triangle.b = {pair.triangle.a.x, height, pair.triangle.b.z};
        pair.triangle.c = {pair.triangle.c.x, height, pair.triangle.a.z};
        pair.triangle.a.y = height;
    }
    if (family == TriangleFamily::corners_on_a_grid) {
        for (int i = 0; i < 3; ++i) {
            pair.box.half[i] = std::abs(whole(random)) + 0.25f;
            pair.triangle.a[i] = whole(random);
            pair.triangle.b[i] = whole(random);
            pair.triangle.c[i] = whole(random);
        }
    }
    if (family == TriangleFamily::sliver)
        pair.triangle.c = pair.triangle.a + (pair.triangle.b - pair.triangle.a) * random.uniform_float(-1, 2);
    pair.size = std::min(detail::size(convex(pair.box)), abut::size(convex(pair.triangle)));
    return pair;
}

/// The gap along a direction out of A; below zero, the depth.
double gap_along(const Convex<3>& a, const Convex<3>& b, const DVec<3>& out) {
    return dot(out, support(b, -out) - support(a, out));
}

class BoxTriangleFamily : public testing::TestWithParam<int> {};

TEST_P(BoxTriangleFamily, AnswersAsTheSearches) {
    const auto family = static_cast<TriangleFamily>(GetParam());
    constexpr int count = 3000;
    int overlapping = 0, apart = 0, unknown = 0;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        SCOPED_TRACE(testing::Message() << "family " << GetParam() << " seed " << seed);
        Random random(seed);
        const BoxAndTriangle pair = random_pair(random, family);
        Convex<3> box = convex(pair.box);
        const Convex<3> triangle = convex(pair.triangle);
        if (random.chance(0.2))
            box = moved(box, affine(Pose3{to_float(random.in_cube<3>() * 0.01), random.rotation<3>()}));
        if (random.chance(0.2)) box.radius = 0.1 * pair.size;
        const double tolerance = 1e-9 * (size(box) + size(triangle) + largest(triangle.place.offset));
        const SignedDistance<3> truth = signed_distance(box, triangle);
        SignedDistance<3> found;
        const PairAnswer answer = box_triangle_distance(box, triangle, 0, found);
        const PairAnswer overlap = box_triangle_overlap(box, triangle);
        if (overlap != PairAnswer::unknown && std::abs(truth.distance) > tolerance) {
            EXPECT_EQ(overlap, truth.distance < 0 ? PairAnswer::yes : PairAnswer::no);
        }
        if (answer == PairAnswer::no) {
            EXPECT_GT(truth.distance, -tolerance);
        }
        apart += answer == PairAnswer::no ? 1 : 0;
        unknown += answer == PairAnswer::unknown ? 1 : 0;
        if (answer != PairAnswer::yes) continue;
        ++overlapping;
        EXPECT_NEAR(found.distance, truth.distance, tolerance + 1e-7 * pair.size);
        EXPECT_NEAR(length(found.normal), 1, 1e-12);
        EXPECT_NEAR(gap_along(box, triangle, found.normal), found.distance, tolerance);
        // The closest points are those that touch first when the shapes approach along the normal.
        EXPECT_NEAR(dot(found.normal, support(box, found.normal) - found.on_a), 0, tolerance);
        EXPECT_LE(signed_distance(box, round_points<3>({to_float(found.on_a)}, 0)).distance,
                  1e-5 * pair.size + tolerance);
        EXPECT_LE(closest_point_on(triangle, found.on_b()).distance, 1e-5 * pair.size + tolerance);
        for (std::size_t i = 0; i < found.corners.count; ++i) {
            EXPECT_LT(found.corners.a[i], 8u);
            EXPECT_LT(found.corners.b[i], 3u);
        }
    }
    if (family == TriangleFamily::sliver) {
        EXPECT_GT(unknown, count / 4);
        return;
    }
    EXPECT_GT(overlapping, count / 5);
    EXPECT_GT(apart, count / 20);
    EXPECT_LT(unknown, count / 10);
}

INSTANTIATE_TEST_SUITE_P(Families, BoxTriangleFamily, testing::Range(0, family_count));

// Known answer: a cube of edge 2 is 0.25 deep in a floor, of which the triangle is one half of a tile.
TEST(BoxTriangle, OfABoxOnAFloor) {
    const Box3 box{{0, 0.75f, 0}, {1, 1, 1}};
    const Triangle3 floor{{-4, 0, -4}, {-4, 0, 8}, {8, 0, -4}};
    SignedDistance<3> found;
    ASSERT_EQ(box_triangle_distance(convex(box), convex(floor), 0, found), PairAnswer::yes);
    EXPECT_EQ(found.distance, -0.25);
    EXPECT_EQ(found.normal, DVec<3>(0, -1, 0));
    EXPECT_EQ(found.on_a.y, -0.25);
    EXPECT_EQ(found.on_b().y, 0);
    EXPECT_EQ(found.corners.count, 3u);
}

TEST(TriangleClosest, IsThatOfTheDistance) {
    int beyond = 0, found_some = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        const double size = random.power_of_two(-8, 9);
        const auto corner = [&] { return to_float(random.in_cube<3>() * size); };
        Convex<3> triangle = convex(Triangle3{corner(), corner(), corner()});
        if (random.chance(0.3)) triangle.radius = 0.1 * size;
        const Vec3 point = corner();
        const SignedDistance<3> truth = signed_distance(round_points<3>({point}, 0), triangle);
        const double tolerance = 1e-9 * size, within = size * random.uniform(0, 1);
        double distance = 0;
        DVec<3> nearest;
        const TriangleClosest answer = closest_point_on_triangle(triangle, DVec<3>(point), within, distance, nearest);
        if (answer == TriangleClosest::beyond) {
            ++beyond;
            EXPECT_GT(truth.distance, within - tolerance);
        }
        if (answer != TriangleClosest::found) continue;
        ++found_some;
        EXPECT_NEAR(distance, truth.distance, tolerance);
        EXPECT_LE(length(nearest - truth.on_b()), 1e-6 * size);
    }
    EXPECT_GT(beyond, 1000);
    EXPECT_GT(found_some, 10000);
}

}  // namespace
}  // namespace abut
