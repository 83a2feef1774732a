// The decisions of the early out by bounding balls, from synthetic measurements.

#include "support/random_shapes.hpp"
#include <abut/world/ball_early_out.hpp>

#include <set>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class S>
detail::ShapeType type_of(const S& shape) {
    return shape_type(View<dimension<S>>(view(shape)));
}

TEST(BallEarlyOut, TypesOfShapes) {
    const Sphere sphere{{0, 0, 0}, 1};
    EXPECT_EQ(type_of(sphere), detail::ShapeType::ball);
    EXPECT_EQ(type_of(stretched(sphere, {1, 2, 3})), detail::ShapeType::ball);
    EXPECT_EQ(type_of(Capsule3{{0, 0, 0}, {1, 0, 0}, 1}), detail::ShapeType::segment);
    EXPECT_EQ(type_of(Triangle3{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), detail::ShapeType::triangle);
    EXPECT_EQ(type_of(*Polygon::build(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})), detail::ShapeType::points);
    EXPECT_EQ(type_of(Box3{{0, 0, 0}, {1, 1, 1}}), detail::ShapeType::box);
    EXPECT_EQ(type_of(Cone{{0, 0, 0}, {1, 0, 0}, 1}), detail::ShapeType::discs);
    EXPECT_EQ(type_of(Diamond<2>{}), detail::ShapeType::function);
    EXPECT_EQ(type_of(stairs<2>(2, 1)), detail::ShapeType::composite);
    EXPECT_EQ(type_of(HalfSpace2{{1, 0}, 0}), detail::ShapeType::half_space);
}

constexpr std::array all_types{
    detail::ShapeType::ball,     detail::ShapeType::segment,    detail::ShapeType::triangle,
    detail::ShapeType::points,   detail::ShapeType::box,        detail::ShapeType::discs,
    detail::ShapeType::function, detail::ShapeType::half_space, detail::ShapeType::composite};

TEST(BallEarlyOut, EachPairOfTypesHasAnEntryOfItsOwn) {
    detail::BallEarlyOuts early_outs;
    std::set<const detail::BallEarlyOuts::Entry*> entries;
    for (const detail::ShapeType a : all_types)
        for (const detail::ShapeType b : all_types)
            for (const bool sensor : {false, true}) {
                entries.insert(&early_outs.entry(a, b, sensor));
                EXPECT_EQ(&early_outs.entry(a, b, sensor), &early_outs.entry(b, a, sensor));
            }
    EXPECT_EQ(entries.size(), 2u * 45);
}

/// Adds samples in which the balls take 5 ns and the shapes `shapes` ns, and one pair in `rare` passes the balls.
void measure(detail::BallEarlyOuts& early_outs, detail::BallEarlyOuts::Entry& entry, int samples, double shapes,
             int rare) {
    for (int i = 0; i < samples; ++i)
        early_outs.add_sample(entry, {20, 25, 20 + shapes}, i % rare == 0, i % (2 * rare) == 0);
}

TEST(BallEarlyOut, IsUsedWhereMeasurementsSayThatItPays) {
    detail::BallEarlyOuts early_outs;
    detail::BallEarlyOuts::Entry& boxes = early_outs.entry(detail::ShapeType::box, detail::ShapeType::box, false);
    detail::BallEarlyOuts::Entry& balls = early_outs.entry(detail::ShapeType::ball, detail::ShapeType::ball, false);
    detail::BallEarlyOuts::Entry& others = early_outs.entry(detail::ShapeType::box, detail::ShapeType::ball, false);
    EXPECT_FALSE(boxes.is_used);
    measure(early_outs, boxes, 31, 300, 4);
    early_outs.decide();
    EXPECT_FALSE(boxes.is_used) << "too few samples";
    measure(early_outs, boxes, 1, 300, 4);
    measure(early_outs, balls, 40, 6, 4);
    EXPECT_FALSE(boxes.is_used) << "decide() was not called";
    early_outs.decide();
    EXPECT_TRUE(boxes.is_used) << "5 + 300 / 4 < 300";
    EXPECT_FALSE(balls.is_used) << "5 + 6 / 4 > 6";
    EXPECT_FALSE(others.is_used);
    // Now the balls overlap nearly always.
    for (int frame = 0; frame < 20; ++frame) {
        measure(early_outs, boxes, 400, 300, 1);
        early_outs.decide();
    }
    EXPECT_FALSE(boxes.is_used);
}

TEST(BallEarlyOut, ForcedModesDontMeasure) {
    for (const BallEarlyOut mode : {BallEarlyOut::always, BallEarlyOut::never, BallEarlyOut::measured}) {
        detail::BallEarlyOuts early_outs(mode);
        int due = 0;
        for (const detail::ShapeType a : all_types)
            for (int i = 0; i < 1000; ++i) due += early_outs.due(early_outs.entry(a, a, true)) ? 1 : 0;
        EXPECT_EQ(due, mode == BallEarlyOut::measured ? 9 * 3 : 0);
        EXPECT_EQ(early_outs.entry(detail::ShapeType::box, detail::ShapeType::box, false).is_used,
                  mode == BallEarlyOut::always);
    }
}

}  // namespace
}  // namespace abut::test
