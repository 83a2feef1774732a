// What a world makes of its measurements, by measurements made up.

#include "random_shapes.hpp"
#include <abut/world/pretest.hpp>

#include <set>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class S>
ShapeType type_of(const S& shape) {
    return shape_type(View<dimension<S>>(view(shape)));
}

TEST(Pretest, TypesOfShapes) {
    const Sphere sphere{{0, 0, 0}, 1};
    EXPECT_EQ(type_of(sphere), ShapeType::ball);
    EXPECT_EQ(type_of(stretched(sphere, {1, 2, 3})), ShapeType::ball);
    EXPECT_EQ(type_of(Capsule3{{0, 0, 0}, {1, 0, 0}, 1}), ShapeType::segment);
    EXPECT_EQ(type_of(Triangle3{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), ShapeType::triangle);
    EXPECT_EQ(type_of(*Polygon::build(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}})), ShapeType::points);
    EXPECT_EQ(type_of(Box3{{0, 0, 0}, {1, 1, 1}}), ShapeType::box);
    EXPECT_EQ(type_of(Cone{{0, 0, 0}, {1, 0, 0}, 1}), ShapeType::discs);
    EXPECT_EQ(type_of(Diamond<2>{}), ShapeType::function);
    EXPECT_EQ(type_of(stairs<2>(2, 1)), ShapeType::composite);
    EXPECT_EQ(type_of(HalfSpace2{{1, 0}, 0}), ShapeType::half_space);
}

constexpr std::array all_types{ShapeType::ball,     ShapeType::segment,    ShapeType::triangle,
                               ShapeType::points,   ShapeType::box,        ShapeType::discs,
                               ShapeType::function, ShapeType::half_space, ShapeType::composite};

TEST(Pretest, EachPairOfTypesHasAnEntryOfItsOwn) {
    Pretests pretests;
    std::set<const Pretests::Entry*> entries;
    for (const ShapeType a : all_types)
        for (const ShapeType b : all_types)
            for (const bool sensor : {false, true}) {
                entries.insert(&pretests.of(a, b, sensor));
                EXPECT_EQ(&pretests.of(a, b, sensor), &pretests.of(b, a, sensor));
            }
    EXPECT_EQ(entries.size(), 2u * 45);
}

/// So many samples of balls that take 5 and shapes that take `shapes`, of which one in `rare` comes to the shapes.
void measure(Pretests& pretests, Pretests::Entry& entry, int samples, double shapes, int rare) {
    for (int i = 0; i < samples; ++i) pretests.add(entry, {20, 25, 20 + shapes}, i % rare == 0, i % (2 * rare) == 0);
}

TEST(Pretest, AsksWhereItPaysOnceItKnows) {
    Pretests pretests;
    Pretests::Entry& boxes = pretests.of(ShapeType::box, ShapeType::box, false);
    Pretests::Entry& balls = pretests.of(ShapeType::ball, ShapeType::ball, false);
    Pretests::Entry& others = pretests.of(ShapeType::box, ShapeType::ball, false);
    EXPECT_FALSE(pretests.asked(boxes));
    measure(pretests, boxes, 31, 300, 4);
    pretests.decide();
    EXPECT_FALSE(pretests.asked(boxes)) << "too few";
    measure(pretests, boxes, 1, 300, 4);
    measure(pretests, balls, 40, 6, 4);
    EXPECT_FALSE(pretests.asked(boxes)) << "not before it is told";
    pretests.decide();
    EXPECT_TRUE(pretests.asked(boxes)) << "5 + 300 / 4 < 300";
    EXPECT_FALSE(pretests.asked(balls)) << "5 + 6 / 4 > 6";
    EXPECT_FALSE(pretests.asked(others));
    // The balls begin to meet nearly always.
    for (int frame = 0; frame < 20; ++frame) {
        measure(pretests, boxes, 400, 300, 1);
        pretests.decide();
    }
    EXPECT_FALSE(pretests.asked(boxes));
}

TEST(Pretest, ForcedModesDontMeasure) {
    for (const Pretest mode : {Pretest::always, Pretest::never, Pretest::measured}) {
        Pretests pretests(mode);
        int due = 0;
        for (const ShapeType a : all_types)
            for (int i = 0; i < 1000; ++i) due += pretests.due(pretests.of(a, a, true)) ? 1 : 0;
        EXPECT_EQ(due, mode == Pretest::measured ? 9 * 3 : 0);
        EXPECT_EQ(pretests.asked(pretests.of(ShapeType::box, ShapeType::box, false)), mode == Pretest::always);
    }
}

}  // namespace
}  // namespace abut::test
