#include "recorder.hpp"
#include <abut/draw/draw.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using test::farthest_from_surface;
using test::Recorder;

constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
const Style filled{{1, 2, 3}, 1, {4, 5, 6}};

// --- 2D shapes ---

TEST(Draw, EveryShapeOfThePlaneIsOneCall) {
    Recorder<2> canvas;
    draw(canvas, Circle{{1, 2}, 3});
    EXPECT_EQ(canvas.balls.size(), 1u);
    draw(canvas, Circle{{1, 2}, 0});
    EXPECT_EQ(canvas.points.size(), 1u);
    draw(canvas, Segment2{{0, 0}, {1, 1}});
    EXPECT_EQ(canvas.lines.size(), 1u);
    draw(canvas, Box2{{0, 0}, {1, 1}}, filled);
    draw(canvas, Aabb2{{0, 0}, {1, 1}});
    draw(canvas, Capsule2{{0, 0}, {1, 1}, 1});
    draw(canvas, stretched(Circle{{1, 2}, 3}, {1, 2}));
    EXPECT_EQ(canvas.polygons.size(), 4u);
    EXPECT_EQ(canvas.polygons[0].style.fill, filled.fill);
    EXPECT_EQ(canvas.polygons[0].points.size(), 4u);
    EXPECT_EQ(canvas.calls(), 7u);
}

TEST(Draw, ABallThatIsMovedOrScaledStaysABall) {
    Recorder<2> canvas;
    draw(canvas, at(rounded(stretched(Circle{{1, 0}, 3}, {2, 2}), 1), {{10, 0}, Turn::by(0.5f)}));
    ASSERT_EQ(canvas.balls.size(), 1u);
    EXPECT_FLOAT_EQ(canvas.balls[0].radius, 7);
    EXPECT_FLOAT_EQ(canvas.balls[0].center.x, 10 + 2 * Turn::by(0.5f).cos);
}

TEST(Draw, AHalfPlaneEndsWhereTheCanvasDoes) {
    Recorder<2> canvas({{0, 0}, {4, 2}});
    draw(canvas, HalfSpace2{{0, 1}, 0.5f}, filled);
    ASSERT_EQ(canvas.lines.size(), 1u);
    EXPECT_EQ(canvas.lines[0].a.y, 0.5f);
    EXPECT_EQ(canvas.lines[0].b.y, 0.5f);
    EXPECT_EQ(std::abs(canvas.lines[0].a.x - canvas.lines[0].b.x), 4);
    ASSERT_EQ(canvas.polygons.size(), 1u);
    EXPECT_EQ(canvas.polygons[0].points, (std::vector<Vec2>{{0, 0}, {4, 0}, {4, 0.5f}, {0, 0.5f}}));
    EXPECT_FALSE(canvas.polygons[0].style.stroke.visible()) << "the edge of the canvas is no edge of the half-plane";

    Recorder<2> corner({{0, 0}, {4, 2}});
    draw(corner, HalfSpace2{{0.6f, 0.8f}, 0.6f}, filled);
    ASSERT_EQ(corner.polygons.size(), 1u);
    EXPECT_EQ(corner.polygons[0].points.size(), 3u);

    Recorder<2> outside({{0, 0}, {4, 2}});
    draw(outside, HalfSpace2{{0, 1}, -1}, filled);
    EXPECT_EQ(outside.calls(), 0u);

    Recorder<2> inside({{0, 0}, {4, 2}});
    draw(inside, HalfSpace2{{0, 1}, 5}, filled);
    ASSERT_EQ(inside.calls(), 1u);
    EXPECT_EQ(inside.polygons[0].points.size(), 4u);
}

// --- 3D shapes ---

/// All lines and areas of a shape lie on it.
template <class S>
void expect_on_surface(const S& shape, const char* name) {
    SCOPED_TRACE(name);
    Recorder<3> lines;
    draw(lines, shape);
    EXPECT_GT(lines.places().size(), 3u);
    for (const auto& area : lines.polygons) EXPECT_FALSE(area.style.fill.visible());
    const double extent = size(View<3>(view(shape)));
    EXPECT_LT(farthest_from_surface(shape, lines.places()), 2e-3 * extent);
    Recorder<3> areas;
    draw(areas, shape, {.stroke = transparent, .fill = {1, 2, 3}});
    EXPECT_LT(farthest_from_surface(shape, areas.places()), 2e-3 * extent);
}

struct Ellipsoid {
    Vec3 radii;
};
[[maybe_unused]] Aabb3 bounds(const Ellipsoid& e) {
    return {-e.radii, e.radii};
}
Vec3 support(const Ellipsoid& e, const Vec3& direction) {
    const Vec3 scaled = e.radii * direction;
    return e.radii * scaled / std::sqrt(scaled.x * scaled.x + scaled.y * scaled.y + scaled.z * scaled.z);
}

TEST(Draw, LinesAndAreasLieOnTheShape) {
    const Box3 box{{3, -2, 1}, {1.5f, 0.2f, 1}, turn_about({0, 0.6f, 0.8f}, 0.7f)};
    const Cylinder can{{1, 2, 3}, {1, 4, 3.5f}, 0.7f};
    const Cone cone{{1, 2, 3}, {1, 4, 3.5f}, 0.7f};
    const Triangle3 triangle{{0, 0, 0}, {1, 3, 1}, {2, 0, 0}};
    const Result<Polyhedron> hull =
        Polyhedron::build({{-1, -2, 0}, {1, -2, 0}, {0, -1, 0}, {0.3f, -3, 0.2f}, {0, -2, 1.5f}, {0.6f, -1.5f, 1}});
    ASSERT_TRUE(hull);
    expect_on_surface(box, "box");
    expect_on_surface(rounded(box, 0.3f), "rounded box");
    expect_on_surface(at(stretched(box, {1, -2, 0.5f}), {{1, 2, 3}, turn_about({1, 0, 0}, 1)}), "mirrored box");
    expect_on_surface(Capsule3{{0, 1, 1}, {5, 2, 3}, 0.3f}, "capsule");
    expect_on_surface(can, "cylinder");
    expect_on_surface(rounded(can, 0.2f), "rounded cylinder");
    expect_on_surface(stretched(can, {1, 0.3f, 2}), "sheared cylinder");
    expect_on_surface(cone, "cone");
    expect_on_surface(rounded(cone, 0.2f), "rounded cone");
    expect_on_surface(triangle, "triangle");
    expect_on_surface(rounded(triangle, 0.2f), "rounded triangle");
    expect_on_surface(*hull, "polyhedron");
    expect_on_surface(rounded(*hull, 0.1f), "rounded polyhedron");
    expect_on_surface(stretched(*hull, {-1, 1, 0.2f}), "mirrored polyhedron");
    expect_on_surface(at(Ellipsoid{{1, 2, 0.5f}}, {{1, 2, 3}, turn_about({1, 0, 0}, 1)}), "a user's shape");
    expect_on_surface(stretched(Sphere{{1, 2, 3}, 1}, {1, 2, 0.5f}), "stretched ball");
    expect_on_surface(stretched(can, {1, 1, 0}), "flattened cylinder");
    expect_on_surface(stretched(box, {1, 1, 0}), "flattened box");
}

TEST(Draw, PolytopesHaveEachEdgeOnce) {
    Recorder<3> canvas;
    draw(canvas, Box3{{0, 0, 0}, {1, 2, 3}}, filled);
    EXPECT_EQ(canvas.lines.size(), 12u);
    ASSERT_EQ(canvas.polygons.size(), 6u);
    for (const auto& area : canvas.polygons) EXPECT_FALSE(area.style.stroke.visible());

    const Result<Polyhedron> hull = Polyhedron::build({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5f, 0.5f, 1}});
    ASSERT_TRUE(hull);
    Recorder<3> pyramid;
    draw(pyramid, *hull, filled);
    EXPECT_EQ(pyramid.lines.size(), 8u);
    EXPECT_EQ(pyramid.polygons.size(), 5u);

    Recorder<3> flat;
    draw(flat, Triangle3{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    EXPECT_EQ(flat.lines.size(), 3u);
    EXPECT_EQ(flat.calls(), 3u);

    Recorder<3> thin;
    draw(thin, Segment3{{0, 0, 0}, {1, 0, 0}}, filled);
    draw(thin, *Polyhedron::build({{0, 0, 0}, {1, 0, 0}}), filled);
    EXPECT_EQ(thin.lines.size(), 2u);
    draw(thin, Polyhedron(), filled);
    EXPECT_EQ(thin.points.size(), 1u);
    EXPECT_EQ(thin.calls(), 3u);
}

/// The volume within the areas; above zero if they are counter-clockwise seen from outside.
double volume_within(const Recorder<3>& canvas) {
    double six_times = 0;
    for (const auto& area : canvas.polygons)
        for (std::size_t i = 2; i < area.points.size(); ++i)
            six_times += dot(DVec<3>(area.points[0]), cross(DVec<3>(area.points[i - 1]), DVec<3>(area.points[i])));
    return six_times / 6;
}

template <class S>
Recorder<3> areas_of(const S& shape) {
    Recorder<3> canvas;
    draw(canvas, shape, {.stroke = transparent, .fill = {1, 2, 3}});
    return canvas;
}
template <class S>
double volume_of_areas(const S& shape) {
    return volume_within(areas_of(shape));
}

TEST(Draw, AreasCloseTheShapeAndFaceOutwards) {
    const Box3 box{{3, -2, 1}, {1.5f, 0.5f, 1}};
    EXPECT_NEAR(volume_of_areas(box), 6, 1e-5);
    EXPECT_NEAR(volume_of_areas(stretched(box, {-1, 1, 1})), 6, 1e-5);

    const double pi = 3.14159265358979;
    const auto expect_nearly = [](double volume, double truth) {
        EXPECT_LT(volume, truth);
        EXPECT_GT(volume, 0.95 * truth);
    };
    expect_nearly(volume_of_areas(Cylinder{{1, 2, 3}, {1, 4, 3}, 0.5f}), pi / 2);
    expect_nearly(volume_of_areas(rounded(Cylinder{{1, 2, 3}, {1, 4, 3.5f}, 0.5f}, 1e-3f)), pi / 4 * 2.07);
    expect_nearly(volume_of_areas(Capsule3{{1, 2, 3}, {1, 4, 3}, 0.5f}), pi / 2 + pi / 6);
    expect_nearly(volume_of_areas(Ellipsoid{{1, 2, 3}}), 8 * pi);
    expect_nearly(volume_of_areas(stretched(Ellipsoid{{1, 2, 3}}, {1, 1, -1})), 8 * pi);
    expect_nearly(volume_of_areas(rounded(Box3{{0, 0, 0}, {1, 1, 1}}, 0.5f)), 8 + 12 + 6 * pi / 4 + pi / 6);
}

TEST(Draw, AreasCoverARoundShapeOnce) {
    const Cylinder can{{-3, 2, -0.5f}, {-3, 2.5f, 0.8f}, 0.6f};
    double area = 0;
    for (const auto& triangle : areas_of(rounded(can, 1e-3f)).polygons) {
        ASSERT_EQ(triangle.points.size(), 3u);
        const DVec<3> a(triangle.points[0]), b(triangle.points[1]), c(triangle.points[2]);
        area += 0.5 * length(cross(b - a, c - a));
    }
    const double pi = 3.14159265358979, tall = length(DVec<3>(can.b) - DVec<3>(can.a));
    const double truth = 2 * pi * 0.6 * tall + 2 * pi * 0.36;
    EXPECT_GT(area, 0.95 * truth);
    EXPECT_LT(area, 1.05 * truth) << "but for slivers along the rims";
}

TEST(Draw, AFlattenedShapeIsDrawnInItsFullWidth) {
    const auto flat = stretched(Cylinder{{1, 2, 3}, {2, 2.3f, 6}, 0.7f}, {1, 1, 0});
    Recorder<3> canvas;
    draw(canvas, flat);
    Aabb3 box = Aabb3::empty();
    for (const Vec3& place : canvas.places()) box = merged(box, Aabb3{place, place});
    const Aabb3 truth = bounds(flat);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(box.min[i], truth.min[i], 1e-5) << i;
        EXPECT_NEAR(box.max[i], truth.max[i], 1e-5) << i;
    }
}

TEST(Draw, APlaneEndsWhereTheCanvasDoes) {
    Recorder<3> canvas({{0, 0, 0}, {4, 2, 1}});
    draw(canvas, HalfSpace3{{0, 0, 1}, 0.5f}, filled);
    ASSERT_EQ(canvas.calls(), 1u);
    ASSERT_EQ(canvas.polygons[0].points.size(), 4u);
    Aabb3 box = Aabb3::empty();
    for (const Vec3& corner : canvas.polygons[0].points) box = merged(box, Aabb3{corner, corner});
    EXPECT_EQ(box, (Aabb3{{0, 0, 0.5f}, {4, 2, 0.5f}}));
    draw(canvas, HalfSpace3{{0, 0, 1}, -0.5f}, filled);
    EXPECT_EQ(canvas.calls(), 1u) << "not to be seen from here";
}

TEST(Draw, OfAMeshTheTrianglesInView) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {100, 0, 0}, {101, 0, 0}, {100, 1, 0}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {3, 4, 5}};
    const Result<Mesh> mesh = Mesh::build(points, triangles);
    ASSERT_TRUE(mesh);
    Recorder<3> near;
    draw(near, *mesh);
    EXPECT_EQ(near.lines.size(), 3u);
    Recorder<3> moved({{-104, -1, -1}, {-98, 2, 1}});
    draw(moved, at(*mesh, {{-200, 0, 0}}));
    ASSERT_EQ(moved.lines.size(), 3u);
    EXPECT_LE(moved.lines[0].a.x, -99);
}

// --- boxes, rays, answers ---

TEST(Draw, BoxesOfABroadPhase) {
    Recorder<2> canvas;
    draw(canvas, Aabb2::empty());
    EXPECT_EQ(canvas.calls(), 0u);
    draw(canvas, Aabb2{{-infinity, 1}, {2, infinity}});
    ASSERT_EQ(canvas.polygons.size(), 1u);
    Aabb2 box = Aabb2::empty();
    for (const Vec2& corner : canvas.polygons[0].points) box = merged(box, Aabb2{corner, corner});
    EXPECT_EQ(box, (Aabb2{{-10, 1}, {2, 10}}));
    const std::vector<Aabb2> boxes(3, Aabb2{{0, 0}, {1, 1}});
    draw(canvas, std::span<const Aabb2>(boxes));
    EXPECT_EQ(canvas.polygons.size(), 4u);
}

/// The tip of the only drawn arrow.
template <int D>
Vec<D> tip(const Recorder<D>& canvas) {
    return canvas.polygons.at(0).points.at(0);
}

TEST(Draw, ARayIsAnArrowAsLongAsItReaches) {
    Recorder<2> finite;
    draw(finite, Ray2{{1, 2}, {1, 0}, 5});
    EXPECT_EQ(finite.lines.size(), 1u);
    EXPECT_EQ(finite.lines[0].a, Vec2(1, 2));
    EXPECT_EQ(tip(finite), Vec2(6, 2));

    Recorder<3> endless;
    draw(endless, Ray3{{1, 2, 3}, {0, -1, 0}});
    EXPECT_EQ(tip(endless), Vec3(1, -10, 3));
    EXPECT_EQ(endless.polygons.size(), 2u) << "a head of two sides across one another";

    Recorder<2> from_outside;
    draw(from_outside, Ray2{{-50, 0}, {1, 0}});
    EXPECT_EQ(tip(from_outside), Vec2(10, 0));

    Recorder<2> never;
    draw(never, Ray2{{50, 0}, {1, 0}});
    draw(never, Ray2{{0, 50}, {1, 0}});
    draw(never, Ray2{{-50, 0}, {0.8f, 0.6f}});
    draw(never, Ray2{{0, 0}, {1, 0}, 0});
    EXPECT_EQ(never.calls(), 0u);
}

TEST(Draw, AHitIsAPointWithItsNormal) {
    Recorder<2> canvas;
    const auto hit = raycast(Ray2{{5, 0}, {-1, 0}}, Circle{{0, 0}, 1});
    ASSERT_TRUE(hit);
    draw(canvas, *hit);
    EXPECT_EQ(canvas.points, std::vector<Vec2>{Vec2(1, 0)});
    EXPECT_GT(tip(canvas).x, 1);
    EXPECT_EQ(tip(canvas).y, 0);
}

TEST(Draw, ClosestIsTwoPointsALineAndANormal) {
    Recorder<2> canvas;
    draw(canvas, closest(Circle{{0, 0}, 1}, Circle{{5, 0}, 1}));
    EXPECT_EQ(canvas.points, (std::vector<Vec2>{{1, 0}, {4, 0}}));
    ASSERT_EQ(canvas.lines.size(), 2u);
    EXPECT_EQ(canvas.lines[0].a, Vec2(1, 0));
    EXPECT_EQ(canvas.lines[0].b, Vec2(4, 0));
    EXPECT_EQ(canvas.lines[1].a, Vec2(1, 0));
    EXPECT_GT(tip(canvas).x, 1);

    Recorder<2> nothing;
    draw(nothing, Closest<2>{});
    EXPECT_EQ(nothing.calls(), 0u) << "a shape without parts is infinitely far";
}

TEST(Draw, AContactHasItsPointsWithNormalsAndDepths) {
    Recorder<2> canvas;
    const Contact<2> contact = abut::contact(Box2{{0, 0}, {2, 1}}, Box2{{0, 1.75f}, {1, 1}});
    ASSERT_EQ(contact.points.size(), 2u);
    draw(canvas, contact);
    EXPECT_EQ(canvas.points.size(), 2u);
    EXPECT_EQ(canvas.polygons.size(), 2u) << "a head for each arrow";
    ASSERT_EQ(canvas.lines.size(), 4u) << "a depth and a shaft for each point";
    EXPECT_NEAR(canvas.lines[0].a.y, 0.75f, 1e-6);
    EXPECT_NEAR(canvas.lines[0].b.y, 1, 1e-6);

    Recorder<3> deep;
    draw(deep, abut::contact(Box3{{0, 0, 0}, {2, 2, 1}}, Box3{{0, 0, 1.75f}, {1, 1, 1}}));
    EXPECT_EQ(deep.points.size(), 4u);

    Recorder<2> nothing;
    draw(nothing, abut::contact(Circle{{0, 0}, 1}, Circle{{5, 0}, 1}));
    EXPECT_EQ(nothing.calls(), 0u);
}

TEST(Draw, OfAWorldTheItemsInView) {
    World2 world;
    world.add(Circle{{0, 0}, 1});
    world.add(Circle{{0, 0}, 2}, {.pose = {{3, 0}}, .sensor = true});
    world.add(Circle{{50, 0}, 1});
    Recorder<2> canvas;
    draw(canvas, world);
    ASSERT_EQ(canvas.balls.size(), 2u);
    EXPECT_EQ(canvas.balls[1].center, Vec2(3, 0));
    EXPECT_EQ(canvas.calls(), 2u);
}

TEST(Draw, WhatIsNotFiniteIsLeftOut) {
    Recorder<2> canvas;
    draw(canvas, Circle{{nan, 0}, 1});
    draw(canvas, Box2{{0, infinity}, {1, 1}});
    draw(canvas, HalfSpace2{{0, 1}, nan});
    draw(canvas, Ray2{{nan, 0}, {1, 0}});
    draw(canvas, Ray2{{0, 0}, {1, 0}, nan});
    draw(canvas, Aabb2{{nan, 0}, {1, 1}});
    EXPECT_EQ(canvas.calls(), 0u);
}

}  // namespace
}  // namespace abut
