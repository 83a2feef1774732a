// Closed forms against the searches that they save, and by hand.

#include "../oracle/pair.hpp"
#include <abut/query/closed_form.hpp>

#include <gtest/gtest.h>

namespace abut {
namespace {

template <int D>
const Convex<D>& convex_of(const oracle::Sample<D>& sample) {
    return std::get<Convex<D>>(sample.view);
}

TEST(ClosedForm, OfABallDeepInABoxIsExact) {
    const Box3 box{{0, 0, 0}, {1, 2, 3}};
    const auto found = closed_form<3>(view(box), view(Sphere{{0.25f, -0.5f, 0.125f}, 0.5f}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->distance, -1.25);
    EXPECT_EQ(found->normal, DVec<3>(1, 0, 0));
    EXPECT_EQ(found->on_a, DVec<3>(1, -0.5, 0.125));
    EXPECT_EQ(found->on_b(), DVec<3>(-0.25, -0.5, 0.125));
}

TEST(ClosedForm, OfCapsulesIsThatOfTheirSegments) {
    const Capsule3 a{{-2, 0, 0}, {2, 0, 0}, 0.5f}, b{{1, 3, -2}, {1, 3, 2}, 1};
    const auto found = closed_form<3>(view(a), view(b));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->distance, 1.5);
    EXPECT_EQ(found->on_a, DVec<3>(1, 0.5, 0));
    EXPECT_EQ(found->on_b(), DVec<3>(1, 2, 0));
}

TEST(ClosedForm, IsNotToldOfSegmentsThatCrossOrHardlyMiss) {
    const Segment<2> a{{-1, 0}, {1, 0}};
    EXPECT_FALSE(closed_form<2>(view(a), view(Segment<2>{{0, -1}, {0, 1}})));
    // So nearly parallel that the places where they are nearest are rounding: here they cross.
    EXPECT_FALSE(closed_form<2>(view(Segment<2>{{0.00603110623f, 1024}, {-0.00603110623f, -1024}}),
                                view(Capsule2{{0, -2048}, {0, 1024}, 0.00603111f})));
    EXPECT_FALSE(closed_form<2>(view(Box2{{0, 0}, {1, 1}}), view(Box2{{5, 0}, {1, 1}})));
}

template <class T>
class ClosedFormOracle : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ClosedFormOracle, Dimensions);

TYPED_TEST(ClosedFormOracle, AgreesWithTheSearches) {
    constexpr int D = TypeParam::value;
    using oracle::Kind;
    constexpr Kind round[] = {Kind::ball, Kind::capsule, Kind::segment};
    constexpr Kind any[] = {Kind::ball, Kind::capsule, Kind::segment, Kind::triangle, Kind::box, Kind::polytope};
    int pairs = 0, told = 0, overlapping = 0;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::amount(10000)); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        Kind kind_a = round[random.below(3)], kind_b = any[random.below(6)];
        if (random.chance(0.5)) std::swap(kind_a, kind_b);
        const auto pair = oracle::random_pair<D>(random, kind_a, kind_b);
        const Convex<D>&a = convex_of(pair.a), &b = convex_of(pair.b);
        ++pairs;
        const auto form = closed_form(a, b);
        if (!form) continue;
        ++told;
        const SignedDistance<D> searched = signed_distance(a, b);
        overlapping += searched.distance <= 0 ? 1 : 0;
        const double margin = oracle::margin_of_doubt(pair.a.solid, pair.b.solid);
        EXPECT_NEAR(form->distance, searched.distance, 0.1 * margin);
        EXPECT_NEAR(length(form->normal), 1, 1e-12);
        EXPECT_NEAR(oracle::gap_along(pair.a.solid, pair.b.solid, form->normal) - a.radius - b.radius, form->distance,
                    0.1 * margin);
    }
    EXPECT_GT(told, pairs / 3);
    EXPECT_GT(overlapping, told * 3 / 10);
    EXPECT_LT(overlapping, told * 7 / 10);
}

}  // namespace
}  // namespace abut
