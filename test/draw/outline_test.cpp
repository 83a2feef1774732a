#include "../oracle/random.hpp"
#include "recorder.hpp"
#include <abut/draw/outline.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

double signed_area(const std::vector<Vec2>& loop) {
    double twice = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        twice += cross(DVec<2>(loop[i]), DVec<2>(loop[(i + 1) % loop.size()]));
    return twice / 2;
}

/// The outline's points lie on the shape, it is counter-clockwise, and no part of the shape is outside of it.
template <class S>
void expect_outline(const S& shape, const char* name) {
    SCOPED_TRACE(name);
    const Convex<2> set = view(shape);
    const std::vector<Vec2> loop = outline(set);
    const double extent = size(set);
    ASSERT_GE(loop.size(), 3u);
    EXPECT_GT(signed_area(loop), 0);
    EXPECT_LT(test::farthest_from_surface(shape, loop), 1e-3 * extent);
    Random random(17);
    for (int i = 0; i < 500; ++i) {
        const DVec<2> direction = random.direction<2>();
        double reach = -std::numeric_limits<double>::infinity();
        for (const Vec2& point : loop) reach = std::max(reach, dot(direction, DVec<2>(point)));
        const double truth = dot(direction, support(set, direction));
        EXPECT_NEAR(reach, truth, extent / 790);
    }
}

TEST(Outline, GoesRoundEveryKindOfShape) {
    const Box2 box{{3, -2}, {1.5f, 0.2f}, Turn::by(0.7f)};
    const Triangle2 clockwise{{0, 0}, {1, 3}, {2, 0}};
    expect_outline(Circle{{100, 7}, 2}, "circle");
    expect_outline(Capsule2{{0, 1}, {5, 2}, 0.3f}, "capsule");
    expect_outline(box, "box");
    expect_outline(rounded(box, 0.5f), "rounded box");
    expect_outline(clockwise, "triangle, its corners clockwise");
    expect_outline(rounded(clockwise, 0.1f), "rounded triangle");
    expect_outline(stretched(Circle{{1, 1}, 1}, {3, 0.5f}), "ellipse");
    expect_outline(at(stretched(Capsule2{{-1, 0}, {1, 0}, 0.5f}, {-0.4f, 1}), {{4, 4}, Turn::by(1)}), "mirrored");
}

TEST(Outline, OfAPolygonIsItsCorners) {
    EXPECT_EQ(outline(convex(Box2{{0, 0}, {2, 1}})).size(), 4u);
    EXPECT_EQ(outline(convex(Triangle2{{0, 0}, {1, 3}, {2, 0}})).size(), 3u);
    EXPECT_EQ(outline(convex(Triangle2{{0, 0}, {1, 0}, {2, 0}})).size(), 2u) << "flat";
    EXPECT_EQ(outline(convex(Segment2{{0, 0}, {1, 1}})), (std::vector<Vec2>{{1, 1}, {0, 0}}));
    EXPECT_EQ(outline(convex(Segment2{{5, 5}, {5, 5}})), (std::vector<Vec2>{{5, 5}}));

    std::vector<Vec2> around;
    for (int i = 0; i < 200; ++i) {
        const Turn turn = Turn::by(0.03f * static_cast<float>(i) + 0.01f * static_cast<float>(i % 3));
        around.push_back({7 + turn.cos, turn.sin});
    }
    const Result<Polygon> polygon = Polygon::build(around);
    ASSERT_TRUE(polygon);
    ASSERT_GT(polygon->points().size(), 100u);
    std::vector<Vec2> loop = outline(convex(*polygon));
    const auto less = [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end(), less), loop.end());
    EXPECT_EQ(loop, std::vector<Vec2>(polygon->points().begin(), polygon->points().end()));
}

TEST(Outline, OfACircleIsARegularPolygon) {
    const std::vector<Vec2> loop = outline(convex(Circle{{0, 0}, 1}));
    ASSERT_EQ(loop.size(), 64u);
    for (std::size_t i = 0; i < 64; ++i)
        EXPECT_NEAR(length(DVec<2>(loop[i]) - DVec<2>(loop[(i + 1) % 64])), 2 * 0.049068, 1e-5);
}

TEST(Outline, OfACylinderInThePlaneOfItsAxisIsARectangle) {
    const Cylinder can{{1, 2, 3}, {1, 4, 3.5f}, 0.7f};
    const DVec<3> u = normalized(DVec<3>(can.b) - DVec<3>(can.a)), side = perpendicular(u), out = cross(u, side);
    const std::vector<Vec3> loop = outline(convex(can), OutlinePlane<3>{side, u});
    ASSERT_EQ(loop.size(), 4u);
    for (const Vec3& corner : loop) EXPECT_NEAR(dot(out, DVec<3>(corner) - DVec<3>(can.a)), 0, 1e-5);
    EXPECT_LT(test::farthest_from_surface(can, loop), 1e-4);
}

TEST(Outline, OfACylinderAcrossItsAxisKeepsToTheEndItIsTiltedTo) {
    const Cylinder can{{0, 0, -1}, {0, 0, 1}, 1};
    for (const double tilt : {-1e-3, 1e-3}) {
        const std::vector<Vec3> ring = outline(convex(can), OutlinePlane<3>{axis<3>(0), axis<3>(1), axis<3>(2, tilt)});
        EXPECT_EQ(ring.size(), 64u);
        for (const Vec3& point : ring) EXPECT_EQ(point.z, tilt < 0 ? -1.0f : 1.0f);
    }
}

/// A support function whose answers grow with each call.
struct Growing {
    mutable float radius = 1;
};
[[maybe_unused]] Aabb2 bounds(const Growing&) {
    return {{-1, -1}, {1, 1}};
}
Vec2 support(const Growing& shape, const Vec2& direction) {
    return direction * ++shape.radius;
}

struct Nowhere {};
[[maybe_unused]] Aabb2 bounds(const Nowhere&) {
    return {{-1, -1}, {1, 1}};
}
Vec2 support(const Nowhere&, const Vec2&) {
    return Vec2(std::numeric_limits<float>::quiet_NaN());
}

TEST(Outline, EndsThoughASupportFunctionContradictsItself) {
    const Growing growing;
    EXPECT_EQ(outline(view(growing)).size(), 4u << 12);
    const Nowhere nowhere;
    EXPECT_LE(outline(view(nowhere)).size(), 4u);
}

}  // namespace
}  // namespace abut
