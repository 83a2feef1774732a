#include "../oracle/random.hpp"
#include <abut/math/aabb.hpp>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

template <class T>
class Boxes : public testing::Test {};
template <int d>
struct Dimension {
    static constexpr int value = d;
};
using Both = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(Boxes, Both);

constexpr float far = std::numeric_limits<float>::infinity();
constexpr float most = std::numeric_limits<float>::max();

template <int D>
Aabb<D> cube(float low, float high) {
    return {Vec<D>(low), Vec<D>(high)};
}

TYPED_TEST(Boxes, AreDeduced) {
    constexpr int D = TypeParam::value;
    const Aabb box{Vec<D>(0), Vec<D>(1)};
    EXPECT_EQ(box, cube<D>(0, 1));
    EXPECT_EQ(Aabb<D>(), cube<D>(0, 0));
}

TYPED_TEST(Boxes, Overlap) {
    constexpr int D = TypeParam::value;
    const auto unit = cube<D>(0, 1);
    EXPECT_TRUE(overlaps(unit, unit));
    EXPECT_TRUE(overlaps(unit, cube<D>(1, 2))) << "corner to corner";
    EXPECT_TRUE(overlaps(unit, cube<D>(0.4f, 0.6f)));
    EXPECT_TRUE(overlaps(unit, cube<D>(-far, far)));
    EXPECT_TRUE(overlaps(unit, cube<D>(1, far)));
    for (int i = 0; i < D; ++i) {
        Aabb<D> beside = unit;
        beside.min[i] = std::nextafter(1.0f, 2.0f);
        beside.max[i] = 3;
        EXPECT_FALSE(overlaps(unit, beside));
        EXPECT_FALSE(overlaps(beside, unit));
    }
}

TYPED_TEST(Boxes, OverlapNothingWhereEmptyOrNotANumber) {
    constexpr int D = TypeParam::value;
    const auto none = Aabb<D>::empty();
    EXPECT_FALSE(overlaps(none, none));
    EXPECT_FALSE(overlaps(none, cube<D>(-far, far)));
    EXPECT_FALSE(overlaps(cube<D>(-far, far), none));
    for (int i = 0; i < D; ++i) {
        auto bad = cube<D>(0, 1);
        bad.min[i] = std::numeric_limits<float>::quiet_NaN();
        EXPECT_FALSE(overlaps(bad, cube<D>(0, 1)));
        EXPECT_FALSE(overlaps(cube<D>(0, 1), bad));
    }
}

TYPED_TEST(Boxes, Contain) {
    constexpr int D = TypeParam::value;
    const auto unit = cube<D>(0, 1);
    EXPECT_TRUE(contains(unit, Vec<D>(1)));
    EXPECT_TRUE(contains(unit, unit));
    EXPECT_TRUE(contains(cube<D>(-far, far), unit));
    EXPECT_FALSE(contains(Aabb<D>::empty(), Vec<D>(0)));
    for (int i = 0; i < D; ++i) {
        Vec<D> point(0.5f);
        point[i] = std::nextafter(1.0f, 2.0f);
        EXPECT_FALSE(contains(unit, point));
        EXPECT_FALSE(contains(unit, Aabb<D>{Vec<D>(0.5f), point}));
        point[i] = -1e-30f;
        EXPECT_FALSE(contains(unit, point));
        EXPECT_FALSE(contains(unit, Aabb<D>{point, Vec<D>(0.5f)}));
    }
}

TYPED_TEST(Boxes, Merge) {
    constexpr int D = TypeParam::value;
    oracle::Random random(1);
    for (int repeat = 0; repeat < 200; ++repeat) {
        const Vec<D> p(random.in_cube<D>()), q(random.in_cube<D>());
        const auto both = merged(Aabb<D>{p, p}, Aabb<D>{q, q});
        EXPECT_TRUE(contains(both, p) && contains(both, q));
        for (int i = 0; i < D; ++i) EXPECT_EQ(both.max[i] - both.min[i], std::abs(p[i] - q[i]));
        EXPECT_EQ(merged(both, Aabb<D>::empty()), both);
        EXPECT_EQ(merged(Aabb<D>::empty(), both), both);
    }
}

TYPED_TEST(Boxes, GrowOutwards) {
    constexpr int D = TypeParam::value;
    oracle::Random random(2);
    for (int repeat = 0; repeat < 2000; ++repeat) {
        const double size = random.power_of_two(-20, 20);
        const Vec<D> a(random.in_cube<D>() * size), b(random.in_cube<D>() * size);
        const Aabb<D> box = merged(Aabb<D>{a, a}, Aabb<D>{b, b});
        const float distance = static_cast<float>(random.power_of_two(-20, 20));
        const Aabb<D> result = grown(box, distance);
        for (int i = 0; i < D; ++i) {
            const double low = double{box.min[i]} - double{distance}, high = double{box.max[i]} + double{distance};
            EXPECT_LE(result.min[i], low) << "seed 2, repeat " << repeat;
            EXPECT_GE(result.max[i], high) << "seed 2, repeat " << repeat;
            const double little = 2.5e-7 * std::max(std::abs(low), std::abs(high)) + 1e-44;
            EXPECT_NEAR(result.min[i], low, std::max(little, 2.5e-7 * std::abs(low)));
            EXPECT_NEAR(result.max[i], high, std::max(little, 2.5e-7 * std::abs(high)));
        }
    }
    EXPECT_EQ(grown(cube<D>(-far, far), 1), cube<D>(-far, far));
    EXPECT_FALSE(overlaps(grown(Aabb<D>::empty(), 1), cube<D>(-far, far)));
}

TYPED_TEST(Boxes, HaveACenter) {
    constexpr int D = TypeParam::value;
    EXPECT_EQ(center(cube<D>(1, 4)), Vec<D>(2.5f));
    EXPECT_EQ(center(cube<D>(-far, far)), Vec<D>(0));
    EXPECT_EQ(center(cube<D>(most / 2, most)), Vec<D>(0.75f * most)) << "no overflow";
    for (const auto& box : {cube<D>(-far, 5), cube<D>(5, far), cube<D>(-far, -most), cube<D>(most, far)}) {
        EXPECT_TRUE(detail::is_finite(center(box)));
        EXPECT_TRUE(contains(box, center(box)));
    }
}

}  // namespace
}  // namespace abut::test
