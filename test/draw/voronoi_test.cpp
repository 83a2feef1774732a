#include "recorder.hpp"
#include <abut/convex/features.hpp>
#include <abut/draw/voronoi.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using test::Recorder;

const Style region_style{{1, 2, 3}, 1, {4, 5, 6, 200}};
const Style lines_only{{1, 2, 3}, 1};

TEST(Voronoi, OfABoxInThePlaneIsAGridWithDiagonals) {
    Recorder<2> canvas;
    draw(canvas, voronoi(Box2{{1, 0}, {2, 2}}), lines_only);
    EXPECT_EQ(canvas.polygons.size(), 0u);
    int rays = 0;
    for (const auto& line : canvas.lines) {
        const Vec2 along = line.b - line.a;
        const bool straight = along.x == 0 || along.y == 0;
        rays += straight ? 1 : 0;
        if (straight)
            EXPECT_EQ(std::max(std::abs(line.b.x), std::abs(line.b.y)), 10) << "to the end of what is shown";
        else
            EXPECT_NEAR(std::abs(along.x), std::abs(along.y), 1e-5) << "a diagonal of the inside";
    }
    EXPECT_EQ(rays, 8);
    EXPECT_EQ(canvas.lines.size(), 12u);
}

/// Whether a point lies in a polygon that is convex and counter-clockwise.
bool holds(const std::vector<Vec2>& points, const Vec2& point) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const DVec<2> a(points[i]), b(points[(i + 1) % points.size()]);
        if (cross(b - a, DVec<2>(point) - a) < 0) return false;
    }
    return true;
}

/// Checks that each point is in one area, and that all points of an area are closest to one feature of the kind that
/// its colour shows.
template <class S>
void expect_regions(const S& shape) {
    Recorder<2> canvas;
    draw(canvas, voronoi(shape), region_style);
    Convex<2> core = view(shape);
    core.radius = 0;
    std::vector<std::uint32_t> owner(canvas.polygons.size(), ~0u);
    oracle::Random random(3);
    for (int i = 0; i < 3000; ++i) {
        const Vec2 point = to_float(random.in_cube<2>() * 10.0);
        const auto found = closest_feature(core, DVec<2>(point));
        std::size_t in = 0;
        for (std::size_t k = 0; k < canvas.polygons.size(); ++k) {
            const auto& area = canvas.polygons[k];
            EXPECT_FALSE(area.style.stroke.visible());
            if (!holds(area.points, point)) continue;
            ++in;
            const bool corner = found.kind == FeatureKind::vertex;
            EXPECT_EQ(area.style.fill.alpha, corner ? 100 : 200);
            if (owner[k] == ~0u) owner[k] = found.index;
            EXPECT_EQ(owner[k], found.index);
        }
        EXPECT_EQ(in, 1u) << point.x << ' ' << point.y;
    }
}

TEST(Voronoi, AreasAreTheRegionsOfTheEngine) {
    expect_regions(Triangle2{{-3, -2}, {4, -1}, {0, 5}});
    expect_regions(Triangle2{{-3, -2}, {0, 5}, {4, -1}});
    expect_regions(Box2{{1, 1}, {3, 2}, Turn::by(0.4f)});
    expect_regions(stretched(Box2{{1, 1}, {3, 2}, Turn::by(0.4f)}, {1, -0.5f}));
    expect_regions(rounded(Box2{{1, 1}, {3, 2}}, 1));
    expect_regions(*Polygon::build({{-4, 0}, {-2, -3}, {3, -4}, {5, 1}, {1, 4}, {-3, 3}}));
}

TEST(Voronoi, OfASegmentTwoLinesAcross) {
    Recorder<2> canvas;
    draw(canvas, voronoi(Segment2{{-1, 0}, {2, 0}}), region_style);
    ASSERT_EQ(canvas.lines.size(), 4u);
    for (const auto& line : canvas.lines) {
        EXPECT_TRUE(line.a.x == -1 || line.a.x == 2);
        EXPECT_EQ(line.a.x, line.b.x);
        EXPECT_EQ(std::abs(line.b.y), 10);
    }
    EXPECT_EQ(canvas.polygons.size(), 4u);
    Recorder<2> capsule;
    draw(capsule, voronoi(Capsule2{{-1, 0}, {2, 0}, 1}), region_style);
    EXPECT_EQ(capsule.lines.size(), 4u) << "those of its core";
}

TEST(Voronoi, NothingIsDrawnBeyondWhatIsShown) {
    const Polygon triangle = *Polygon::build({{-4, 0}, {3, -4}, {1, 4}});
    for (const float far : {0.0f, 12.0f, 1000.0f}) {
        SCOPED_TRACE(far);
        Recorder<2> canvas;
        draw(canvas, voronoi(at(triangle, {{far, 0}, Turn::by(1)})), region_style);
        EXPECT_GT(canvas.polygons.size(), 0u);
        for (const Vec2& place : canvas.places()) EXPECT_LE(std::max(std::abs(place.x), std::abs(place.y)), 10.00001f);
    }
}

TEST(Voronoi, InSpaceTheWallsOnTheEdgesOfFaces) {
    Recorder<3> canvas;
    const Box3 box{{1, 0, 0}, {1, 1, 1}};
    draw(canvas, voronoi(box), region_style);
    const auto walls = std::count_if(canvas.polygons.begin(), canvas.polygons.end(),
                                     [](const auto& area) { return area.style.fill.visible(); });
    EXPECT_EQ(walls, 24) << "one a face and edge";
    const double high = size(convex(box)) / 2;
    for (const auto& area : canvas.polygons) {
        if (!area.style.fill.visible()) continue;
        ASSERT_EQ(area.points.size(), 4u);
        EXPECT_NEAR(length(DVec<3>(area.points[3]) - DVec<3>(area.points[0])), high, 1e-5);
        EXPECT_NEAR(length(DVec<3>(area.points[1]) - DVec<3>(area.points[0])), 2, 1e-5);
    }
    Recorder<3> triangle;
    draw(triangle, voronoi(Triangle3{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), lines_only);
    EXPECT_GE(triangle.lines.size(), 6u);
    for (const auto& area : triangle.polygons) EXPECT_FALSE(area.style.fill.visible());
}

TEST(Voronoi, NothingOfWhatHasNoFeatures) {
    Recorder<2> canvas;
    draw(canvas, voronoi(Circle{{0, 0}, 1}), region_style);
    draw(canvas, voronoi(HalfSpace2{{0, 1}, 0}), region_style);
    draw(canvas, voronoi(stretched(Circle{{0, 0}, 1}, {1, 2})), region_style);
    draw(canvas, voronoi(Box2{{std::numeric_limits<float>::quiet_NaN(), 0}, {1, 1}}), region_style);
    EXPECT_EQ(canvas.calls(), 0u);
    Recorder<3> space;
    draw(space, voronoi(Sphere{{0, 0, 0}, 1}), region_style);
    draw(space, voronoi(Cylinder{{0, 0, 0}, {1, 0, 0}, 1}), region_style);
    EXPECT_EQ(space.calls(), 0u);
}

}  // namespace
}  // namespace abut
