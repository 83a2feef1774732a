// Distances with known answers.

#include "../oracle/expect.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

namespace abut {
namespace {

using oracle::is_unit;
using oracle::near;

TEST(Closest, OfTwoCirclesIsAlongTheLineOfTheirCenters) {
    const Closest<2> found = closest(Circle{{0, 0}, 1}, Circle{{3, 4}, 2});
    EXPECT_FLOAT_EQ(found.distance, 2);
    EXPECT_TRUE(near(found.normal, Vec2(0.6f, 0.8f)));
    EXPECT_TRUE(near(found.on_a, Vec2(0.6f, 0.8f)));
    EXPECT_TRUE(near(found.on_b, Vec2(1.8f, 2.4f)));
}

TEST(Closest, OfASphereAndACorner) {
    // From the corner (1, 1, 1) to the center it is (1, 2, 2), which is 3 long.
    const Closest<3> found = closest(Box3{{0, 0, 0}, {1, 1, 1}}, Sphere{{2, 3, 3}, 1});
    EXPECT_FLOAT_EQ(found.distance, 2);
    EXPECT_TRUE(near(found.normal, Vec3(1, 2, 2) / 3.0f));
    EXPECT_TRUE(near(found.on_a, Vec3(1, 1, 1)));
    EXPECT_EQ(found.feature_a.kind, FeatureKind::vertex);
}

TEST(Closest, OfASphereAndAnEdgeOrAFace) {
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    const Closest<3> edge = closest(box, Sphere{{0.5f, 4, 5}, 2});
    EXPECT_FLOAT_EQ(edge.distance, 3);
    EXPECT_TRUE(near(edge.on_a, Vec3(0.5f, 1, 1)));
    EXPECT_EQ(edge.feature_a.kind, FeatureKind::edge);
    const Closest<3> face = closest(box, Sphere{{0.5f, 0.25f, 4}, 2});
    EXPECT_FLOAT_EQ(face.distance, 1);
    EXPECT_TRUE(near(face.on_a, Vec3(0.5f, 0.25f, 1)));
    EXPECT_EQ(face.feature_a.kind, FeatureKind::face);
}

TEST(Closest, OfSkewSegmentsIsAlongTheirCommonPerpendicular) {
    const Closest<3> found = closest(Segment<3>{{-1, 0, 0}, {3, 0, 0}}, Segment<3>{{1, 2, -5}, {1, 2, 5}});
    EXPECT_FLOAT_EQ(found.distance, 2);
    EXPECT_TRUE(near(found.on_a, Vec3(1, 0, 0)));
    EXPECT_TRUE(near(found.on_b, Vec3(1, 2, 0)));
}

TEST(Closest, OfTwoCubesEdgeToEdge) {
    // Both boxes are rotated by 45 degrees, about different axes. Their edges cross at right angles, sqrt(2) from each
    // center.
    const Box3 a{{0, 0, 0}, {1, 1, 1}, turn_about({0, 0, 1}, 0.785398163f)};
    const Box3 b{{4, 0, 0}, {1, 1, 1}, turn_about({0, 1, 0}, 0.785398163f)};
    const Closest<3> found = closest(a, b);
    EXPECT_NEAR(found.distance, 4 - 2 * std::sqrt(2.0), 1e-6);
    EXPECT_TRUE(near(found.normal, Vec3(1, 0, 0)));
    const Closest<3> deep = closest(a, Box3{{2.5f, 0, 0}, b.half, b.rotation});
    EXPECT_NEAR(deep.distance, 2.5 - 2 * std::sqrt(2.0), 1e-6);
    EXPECT_TRUE(near(deep.normal, Vec3(1, 0, 0)));
    EXPECT_TRUE(near(deep.on_a, Vec3(static_cast<float>(std::sqrt(2.0)), 0, 0)));
}

TEST(Closest, OfNestedBoxesIsTheLeastWayOut) {
    // To the right the small one must go 5 - 2 + 1 = 4, upwards only 3 - 0.5 + 1 = 3.5.
    const Closest<2> found = closest(Box2{{0, 0}, {5, 3}}, Box2{{2, 0.5f}, {1, 1}});
    EXPECT_FLOAT_EQ(found.distance, -3.5f);
    EXPECT_TRUE(near(found.normal, Vec2(0, 1)));
    EXPECT_FLOAT_EQ(found.on_a.y, 3);
    EXPECT_FLOAT_EQ(found.on_b.y, -0.5f);
}

TEST(Closest, OfConcentricAndIdenticalShapesHasADirection) {
    const Closest<3> spheres = closest(Sphere{{1, 2, 3}, 2}, Sphere{{1, 2, 3}, 1});
    EXPECT_FLOAT_EQ(spheres.distance, -3);
    EXPECT_TRUE(is_unit(spheres.normal));
    const Box3 box{{1, 2, 3}, {1, 2, 3}};
    const Closest<3> boxes = closest(box, box);
    EXPECT_FLOAT_EQ(boxes.distance, -2);
    EXPECT_FLOAT_EQ(std::abs(boxes.normal.x), 1);
    const Closest<2> points = closest(Circle{{1, 1}, 0}, Circle{{1, 1}, 0});
    EXPECT_EQ(points.distance, 0);
    EXPECT_TRUE(is_unit(points.normal));
}

TEST(Closest, OfThinShapesThatCrossIsZero) {
    const Closest<3> crossing = closest(Segment<3>{{-1, 0, 0}, {1, 0, 0}}, Segment<3>{{0, -1, 0}, {0, 1, 0}});
    EXPECT_NEAR(crossing.distance, 0, 1e-7);
    EXPECT_NEAR(std::abs(crossing.normal.z), 1, 1e-6);
    EXPECT_TRUE(near(crossing.on_a, Vec3(0, 0, 0)));
    const Closest<3> flat =
        closest(Triangle<3>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, Triangle<3>{{1, 1, 0}, {9, 1, 0}, {1, 9, 0}});
    EXPECT_NEAR(flat.distance, 0, 1e-7);
    EXPECT_NEAR(std::abs(flat.normal.z), 1, 1e-6);
}

TEST(Closest, OfATriangleThroughABoxIsTheWayOutOfTheBox) {
    // The triangle lies in the plane x = 0.75 and is larger than the box: the depth is a quarter, to the right.
    const Triangle<3> triangle{{0.75f, -9, -9}, {0.75f, 9, -9}, {0.75f, 0, 9}};
    const Closest<3> found = closest(Box3{{0, 0, 0}, {1, 1, 1}}, triangle);
    EXPECT_FLOAT_EQ(found.distance, -0.25f);
    EXPECT_TRUE(near(found.normal, Vec3(1, 0, 0)));
}

TEST(Closest, OfATurnedBoxAndAHalfSpace) {
    // The box stands on its corner, which is sqrt(3) below the center.
    const glm::quat on_corner = turn_about(Vec3(0.70710678f, 0, -0.70710678f), 0.95531662f);
    const Closest<3> found = closest(Box3{{0, 2, 0}, {1, 1, 1}, on_corner}, HalfSpace3{{0, 1, 0}, 0});
    EXPECT_NEAR(found.distance, 2 - std::sqrt(3.0), 1e-5);
    EXPECT_TRUE(near(found.normal, Vec3(0, -1, 0)));
    EXPECT_TRUE(near(found.on_b, Vec3(0, 0, 0), 1e-5));
}

TEST(Closest, OfACylinderAndACone) {
    // From the rim at (2, 1, 0) to the center it is (3, 4, 0).
    const Closest<3> beside = closest(Cylinder{{0, -1, 0}, {0, 1, 0}, 2}, Sphere{{5, 5, 0}, 1});
    EXPECT_NEAR(beside.distance, 4, 1e-5);
    EXPECT_TRUE(near(beside.on_a, Vec3(2, 1, 0), 1e-4));
    const Closest<3> slope = closest(Cone{{0, 0, 0}, {0, 4, 0}, 3}, Sphere{{4.8f, 5.6f, 0}, 1});
    // The side runs from (3, 0) to (0, 4) with normal (4, 3) / 5: (4.8, 5.6) is (19.2 + 16.8 - 12) / 5 = 4.8 above it,
    // and above the point (0.96, 2.72).
    EXPECT_NEAR(slope.distance, 3.8, 1e-5);
    EXPECT_TRUE(near(slope.on_a, Vec3(0.96f, 2.72f, 0), 1e-3));
}

TEST(Closest, OfAPoint) {
    const Box2 box{{0, 0}, {2, 1}};
    const Closest<2> outside = closest(box, Vec2(5, 5));
    EXPECT_FLOAT_EQ(outside.distance, 5);
    EXPECT_TRUE(near(outside.on_a, Vec2(2, 1)));
    EXPECT_TRUE(near(outside.normal, Vec2(0.6f, 0.8f)));
    const Closest<2> inside = closest(box, Vec2(1.5f, 0.25f));
    EXPECT_FLOAT_EQ(inside.distance, -0.5f);
    EXPECT_TRUE(near(inside.on_a, Vec2(2, 0.25f)));
}

TEST(Closest, FarFromTheOriginIsAsGood) {
    // The gap is 1/16, and the spacing of floats at a million is 1/16 as well.
    const Vec3 far(1e6f, -1e6f, 5e5f);
    const Closest<3> found = closest(Box3{far, {1, 1, 1}}, Sphere{far + Vec3(2.0625f, 0, 0), 1});
    EXPECT_EQ(found.distance, 0.0625f);
    EXPECT_EQ(found.normal, Vec3(1, 0, 0));
}

TEST(Overlaps, CountsTouching) {
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(overlaps(box, Box3{{2, 0, 0}, {1, 1, 1}}));
    EXPECT_TRUE(overlaps(box, Box3{{2, 2, 0}, {1, 1, 1}}));
    EXPECT_TRUE(overlaps(box, Box3{{2, 2, 2}, {1, 1, 1}}));
    EXPECT_TRUE(overlaps(box, Sphere{{0, 3, 0}, 2}));
    EXPECT_TRUE(overlaps(Circle{{0, 0}, 2}, Circle{{3, 4}, 3}));
    EXPECT_TRUE(overlaps(Segment<2>{{0, 0}, {2, 2}}, Segment<2>{{1, 1}, {1, -5}}));
    EXPECT_TRUE(overlaps(box, HalfSpace3{{0, 1, 0}, -1}));
    EXPECT_TRUE(overlaps(Triangle<2>{{0, 0}, {1, 0}, {0, 1}}, Triangle<2>{{1, 0}, {2, 0}, {2, 2}}));
}

TEST(Overlaps, ReportsNearMisses) {
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    EXPECT_FALSE(overlaps(box, Box3{{2.0001f, 0, 0}, {1, 1, 1}}));
    EXPECT_FALSE(overlaps(box, Box3{{2.0001f, 2, 2}, {1, 1, 1}}));
    EXPECT_FALSE(overlaps(Circle{{0, 0}, 2}, Circle{{3, 4}, 2.999f}));
    // The corner of the upper square is in the bounding box of the triangle, and not in the triangle.
    EXPECT_FALSE(overlaps(Triangle<2>{{0, 0}, {4, 0}, {0, 4}}, Box2{{3.1f, 3.1f}, {1, 1}}));
}

TEST(Overlaps, FindsWhatIsInside) {
    EXPECT_TRUE(overlaps(Sphere{{0, 0, 0}, 100}, Sphere{{1, 2, 3}, 0.001f}));
    EXPECT_TRUE(overlaps(Circle{{1, 2}, 0}, Box2{{0, 0}, {5, 5}}));
    EXPECT_TRUE(overlaps(Segment<3>{{-1, 0, 0}, {1, 0, 0}},
                         *Polyhedron::build({{-9, -9, -9}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}})));
}

template <class A, class B>
constexpr bool pairs = Pair<A, B>;

TEST(Pair, RefusesWrongPairings) {
    static_assert(pairs<Circle, Box2> && pairs<Sphere, Cone> && pairs<HalfSpace3, Sphere> && pairs<Circle, HalfSpace2>);
    static_assert(!pairs<Circle, Sphere> && !pairs<Box3, Segment<2>> && !pairs<Capsule<2>, HalfSpace3>);
    static_assert(!pairs<HalfSpace2, HalfSpace2> && !pairs<HalfSpace3, HalfSpace3>);
    static_assert(!pairs<Rounded<HalfSpace3>, At<HalfSpace3>>);
    static_assert(!pairs<Sphere, int> && !pairs<float, float> && !pairs<Vec3, Sphere>);
    static_assert(!pairs<At<Circle>, Rounded<Sphere>> && pairs<At<Circle>, Rounded<Circle&>>);
}

}  // namespace
}  // namespace abut
