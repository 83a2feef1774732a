#include "recorder.hpp"
#include <abut/draw/trace.hpp>

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace abut {
namespace {

using test::Recorder;

const Style style{{1, 2, 3, 200}, 1, {4, 5, 6, 100}};

template <int D>
Trace<D> trace_of(std::initializer_list<TraceStep<D>> steps) {
    Trace<D> trace;
    trace.steps = steps;
    return trace;
}

TEST(DrawTrace, GjkIsItsSimplexesAndTheOriginAndTheClosestPoints) {
    Recorder<2> canvas;
    const GjkStep<2> corner{{Vec2(2, 1)}, 1, {2, 1}}, edge{{Vec2(2, 1), Vec2(2, -3)}, 2, {2, 0}},
        triangle{{Vec2(2, 1), Vec2(2, -3), Vec2(-1, 0)}, 3, {0, 0}};
    draw(canvas, trace_of<2>({corner, edge, triangle}), style);
    EXPECT_EQ(canvas.points, (std::vector<Vec2>{{2, 1}, {2, 1}, {2, 0}, {0, 0}})) << "a corner is a point itself";
    ASSERT_EQ(canvas.polygons.size(), 1u);
    EXPECT_EQ(canvas.polygons[0].points, (std::vector<Vec2>{{2, 1}, {2, -3}, {-1, 0}}));
    ASSERT_EQ(canvas.lines.size(), 2u + 3u + 1u) << "the mark of the origin, a line from it each time, the edge";
    EXPECT_EQ(canvas.texts, (std::vector<std::string>{"1", "2", "3"}));
}

TEST(DrawTrace, LaterStepsAreStronger) {
    Recorder<2> canvas;
    const GjkStep<2> edge{{Vec2(2, 1), Vec2(2, -3)}, 2, {2, 0}};
    draw(canvas, trace_of<2>({edge, edge, edge, edge}), style);
    std::vector<int> strengths;
    for (const auto& line : canvas.lines)
        if (line.a == Vec2(2, 1)) strengths.push_back(line.style.stroke.alpha);
    ASSERT_EQ(strengths.size(), 4u);
    for (std::size_t i = 1; i < 4; ++i) EXPECT_LT(strengths[i - 1], strengths[i]);
    EXPECT_GT(strengths[0], 40);
    EXPECT_EQ(strengths[3], 200) << "as the style has it";
}

TEST(DrawTrace, ASimplexOfFourIsItsSixEdges) {
    Recorder<3> canvas;
    const GjkStep<3> step{{Vec3(1, 0, 0), Vec3(-1, 1, 0), Vec3(-1, -1, 0), Vec3(0, 0, 2)}, 4, {0, 0, 0}};
    draw(canvas, trace_of<3>({step}), style);
    EXPECT_EQ(canvas.lines.size(), 3u + 6u + 1u);
}

TEST(DrawTrace, PenetrationIsAFaceWithItsNormal) {
    Recorder<2> flat;
    draw(flat, trace_of<2>({PenetrationStep<2>{{Vec2(3, -2), Vec2(3, 4)}, {1, 0}, 3, 4}}), style);
    ASSERT_EQ(flat.polygons.size(), 1u) << "the arrow's head";
    EXPECT_GT(flat.polygons[0].points[0].x, 3);
    EXPECT_EQ(flat.polygons[0].points[0].y, 1);
    EXPECT_TRUE(std::any_of(flat.lines.begin(), flat.lines.end(), [](const auto& line) {
        return line.style.dashed && line.a == Vec2(0, 0) && line.b == Vec2(3, 0);
    })) << "from the origin to the face's line";
    EXPECT_EQ(flat.texts.size(), 1u);

    Recorder<3> space;
    draw(space, trace_of<3>({PenetrationStep<3>{{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)}, {0, 0, 1}, 1, 2}}),
         style);
    EXPECT_EQ(space.polygons.size(), 1u + 2u);
}

TEST(DrawTrace, AnAxisIsTwoIntervalsSideBySide) {
    Recorder<2> canvas({{95, -5}, {105, 5}});
    draw(canvas, trace_of<2>({AxisStep<2>{{1, 0}, 96, 99, 98, 103}}), style);
    ASSERT_EQ(canvas.lines.size(), 2u);
    const auto &a = canvas.lines[0], &b = canvas.lines[1];
    EXPECT_FLOAT_EQ(a.a.x, 96);
    EXPECT_FLOAT_EQ(a.b.x, 99);
    EXPECT_FLOAT_EQ(b.a.x, 98);
    EXPECT_FLOAT_EQ(b.b.x, 103);
    EXPECT_EQ(a.a.y, a.b.y);
    EXPECT_NE(a.a.y, b.a.y);
    EXPECT_FALSE(a.style.dashed);
    EXPECT_TRUE(b.style.dashed);
    for (const Vec2& place : canvas.places()) EXPECT_TRUE(std::abs(place.y) <= 5) << "within what is shown";
}

TEST(DrawTrace, ACutIsItsLineAndWhatIsLeft) {
    Recorder<2> canvas;
    draw(canvas, trace_of<2>({ClipStep<2>{{0, 1}, 2, {{0, 0}, {3, 0}, {1, 2}}}, ClipStep<2>{{0, 1}, -1, {}}}), style);
    ASSERT_EQ(canvas.lines.size(), 2u);
    EXPECT_EQ(canvas.lines[0].a.y, 2);
    EXPECT_EQ(std::abs(canvas.lines[0].b.x), 10);
    EXPECT_TRUE(canvas.lines[0].style.dashed);
    ASSERT_EQ(canvas.polygons.size(), 1u);
    EXPECT_EQ(canvas.polygons[0].points.size(), 3u);
    EXPECT_TRUE(canvas.polygons[0].style.fill.visible());
    EXPECT_EQ(canvas.texts.size(), 2u);

    Recorder<3> space;
    draw(space, trace_of<3>({ClipStep<3>{{0, 0, 1}, 2, {{0, 0, 0}, {3, 0, 0}}}}), style);
    EXPECT_EQ(space.polygons.size(), 1u) << "the plane";
    EXPECT_EQ(space.lines.size(), 1u) << "an edge is left";
}

TEST(DrawTrace, NothingOfNothingAndNotOfWhatIsNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Recorder<2> canvas;
    draw(canvas, Trace<2>{}, style);
    draw(canvas,
         trace_of<2>({GjkStep<2>{}, GjkStep<2>{{Vec2(nan, 0)}, 1, {0, 0}}, PenetrationStep<2>{{}, {nan, 0}, 0, 0},
                      AxisStep<2>{{1, 0}, 0, nan, 0, 1}, ClipStep<2>{{1, 0}, nan, {}}}),
         style);
    EXPECT_EQ(canvas.calls(), 0u);
}

}  // namespace
}  // namespace abut
