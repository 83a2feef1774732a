// Ties between parts of a composite shape that are equally near or deep: the lowest index is reported, in whatever
// order the shape visits its parts. Regression: of 180,000 distances to meshes, 3680 reported another part after the
// mesh's tree was rebuilt.

#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>

#include <cstdint>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// Four boxes of equal distance and shape around the origin, visited in one order or the reverse.
struct FourBoxes {
    bool backwards = false;
};

Aabb3 box_of(std::uint32_t part) {
    const float side = part % 2 == 0 ? 2.0f : -2.0f;
    const Vec3 middle = part < 2 ? Vec3{side, 0, 0} : Vec3{0, side, 0};
    return {middle - 1.0f, middle + 1.0f};
}

Aabb3 bounds(const FourBoxes&) {
    return {{-3, -3, -1}, {3, 3, 1}};
}

template <class F>
void each_part(const FourBoxes& shape, const Aabb3& box, F&& visit) {
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t part = shape.backwards ? 3 - i : i;
        if (overlaps(box_of(part), box) && !visit(box_of(part), part)) return;
    }
}

TEST(Ties, OfTheNearestPartsTheLowestIsReported) {
    const Sphere ball{{0, 0, 0}, 0.25f};
    for (const bool backwards : {false, true}) {
        const Closest<3> found = closest(ball, FourBoxes{backwards});
        EXPECT_FLOAT_EQ(found.distance, 0.75f);
        EXPECT_EQ(found.feature_b.part, 0u) << backwards;
        EXPECT_EQ(closest(FourBoxes{backwards}, ball).feature_a.part, 0u) << backwards;
    }
}

TEST(Ties, OfTheDeepestPartsTheLowestIsReported) {
    const Sphere ball{{0, 0, 0}, 1.25f};
    for (const bool backwards : {false, true}) {
        const Contact<3> found = contact(ball, FourBoxes{backwards});
        ASSERT_TRUE(found);
        EXPECT_FLOAT_EQ(found.depth, 0.25f);
        EXPECT_EQ(found.feature_b.part, 0u) << backwards;
    }
}

}  // namespace
}  // namespace abut
