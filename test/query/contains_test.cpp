// Points in shapes, with known answers.

#include <abut/query/contains.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <gtest/gtest.h>

namespace abut {
namespace {

TEST(Contains, CountsTheSurface) {
    EXPECT_TRUE(contains(Circle{{0, 0}, 5}, Vec2(3, 4)));
    EXPECT_FALSE(contains(Circle{{0, 0}, 5}, Vec2(3, 4.001f)));
    EXPECT_TRUE(contains(Box2{{0, 0}, {1, 2}}, Vec2(1, 2)));
    EXPECT_FALSE(contains(Box2{{0, 0}, {1, 2}}, Vec2(1.001f, 2)));
    EXPECT_TRUE(contains(Aabb3{{0, 0, 0}, {1, 1, 1}}, Vec3(0, 0.5f, 1)));
    EXPECT_TRUE(contains(HalfSpace3{{0, 1, 0}, 2}, Vec3(7, 2, -7)));
    EXPECT_FALSE(contains(HalfSpace3{{0, 1, 0}, 2}, Vec3(7, 2.001f, -7)));
}

TEST(Contains, KnowsTurnedBoxes) {
    // The square stands on its corner: it contains (0, 1.4) and not (1, 1).
    const Box2 box{{0, 0}, {1, 1}, Turn::by(0.785398163f)};
    EXPECT_TRUE(contains(box, Vec2(0, 1.4f)));
    EXPECT_FALSE(contains(box, Vec2(1, 1)));
}

TEST(Contains, KnowsRoundEnds) {
    const Capsule<2> capsule{{0, 0}, {4, 0}, 1};
    EXPECT_TRUE(contains(capsule, Vec2(4.7f, 0.7f)));
    EXPECT_FALSE(contains(capsule, Vec2(4.8f, 0.8f)));
    EXPECT_TRUE(contains(Capsule<3>{{0, 0, 0}, {4, 0, 0}, 1}, Vec3(2, 0.59f, -0.79f)));
    const Cylinder cylinder{{0, 0, 0}, {0, 2, 0}, 5};
    EXPECT_TRUE(contains(cylinder, Vec3(2.99f, 1, -3.99f)));
    EXPECT_FALSE(contains(cylinder, Vec3(3.01f, 1, -4.01f)));
    EXPECT_FALSE(contains(cylinder, Vec3(0, 2.01f, 0)));
    const Cone cone{{0, 0, 0}, {0, 4, 0}, 2};
    EXPECT_TRUE(contains(cone, Vec3(0.99f, 2, 0)));
    EXPECT_FALSE(contains(cone, Vec3(1.01f, 2, 0)));
}

TEST(Contains, TakesThinShapesAsClosedSets) {
    EXPECT_TRUE(contains(Segment<2>{{0, 0}, {4, 2}}, Vec2(2, 1)));
    EXPECT_FALSE(contains(Segment<2>{{0, 0}, {4, 2}}, Vec2(2, 1.01f)));
    EXPECT_TRUE(contains(Triangle<2>{{0, 0}, {4, 0}, {0, 4}}, Vec2(2, 2)));
    EXPECT_FALSE(contains(Triangle<2>{{0, 0}, {4, 0}, {0, 4}}, Vec2(2.01f, 2)));
    EXPECT_TRUE(contains(Triangle<3>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, Vec3(1, 1, 0)));
    EXPECT_FALSE(contains(Triangle<3>{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, Vec3(1, 1, 0.01f)));
    EXPECT_TRUE(contains(Sphere{{1, 2, 3}, 0}, Vec3(1, 2, 3)));
}

TEST(Contains, KnowsHullsAndViews) {
    EXPECT_TRUE(contains(*Polygon::build({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 5}}), Vec2(2, 4.9f)));
    EXPECT_FALSE(contains(*Polygon::build({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 5}}), Vec2(3, 4.9f)));
    EXPECT_TRUE(contains(*Polyhedron::build({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}}), Vec3(1, 1, 0.99f)));
    EXPECT_FALSE(contains(*Polyhedron::build({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}}), Vec3(1, 1, 1.01f)));
    EXPECT_TRUE(contains(at(Circle{{1, 0}, 1}, Pose2{{10, 0}, Turn{0, 1}}), Vec2(10, 1.99f)));
    EXPECT_TRUE(contains(rounded(Box2{{0, 0}, {1, 1}}, 1), Vec2(1.7f, 1.7f)));
    EXPECT_FALSE(contains(rounded(Box2{{0, 0}, {1, 1}}, 1), Vec2(1.8f, 1.8f)));
    EXPECT_TRUE(contains(stretched(Circle{{0, 0}, 1}, Vec2(3, 1)), Vec2(2.9f, 0)));
}

TEST(Contains, TakesAClosedMeshAsSolidAndAnOpenOneAsItsTriangles) {
    const std::vector<Vec3> points{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
    const std::vector<glm::uvec3> closed{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const std::vector<glm::uvec3> open(closed.begin(), closed.end() - 1);
    const Vec3 inside(0.5f, 0.5f, 0.5f), on_face(1, 1, 0);
    EXPECT_TRUE(contains(*Mesh::build(points, closed), inside));
    EXPECT_FALSE(contains(*Mesh::build(points, open), inside));
    EXPECT_TRUE(contains(*Mesh::build(points, open), on_face));
    EXPECT_TRUE(contains(at(*Mesh::build(points, closed), Pose3{{10, 0, 0}}), inside + Vec3(10, 0, 0)));
    EXPECT_FALSE(contains(at(*Mesh::build(points, closed), Pose3{{10, 0, 0}}), inside));
}

}  // namespace
}  // namespace abut
