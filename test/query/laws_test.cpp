// Invariants of the answers for every pair.

#include "../oracle/check.hpp"
#include "../oracle/expect.hpp"
#include "../oracle/pair.hpp"
#include <abut/query/contains.hpp>

namespace abut {

using namespace detail;

namespace {

using oracle::near;

template <class T>
class Laws : public testing::Test {
protected:
    static constexpr int dimensions = T::value;
    struct Case {
        const oracle::Sample<dimensions>& a;
        const oracle::Sample<dimensions>& b;
        Closest<dimensions> answer;
        double margin;
        double rounding;  ///< the rounding of coordinates in the world
        oracle::Random& random;
    };

    /// Visits random pairs of every two kinds; 30 to 70 percent of them overlap.
    template <class Visit>
    static void each_case(std::uint64_t first_seed, Visit&& visit) {
        constexpr int D = dimensions;
        int pairs = 0, overlapping = 0;
        for (int kind_a = 0; kind_a < oracle::kind_count; ++kind_a)
            for (int kind_b = 0; kind_b < oracle::kind_count; ++kind_b)
                for (int i = 0; i < oracle::case_count(10); ++i) {
                    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(pairs++);
                    SCOPED_TRACE(testing::Message() << "seed " << seed << ", kinds " << kind_a << " and " << kind_b);
                    oracle::Random random(seed);
                    const auto pair = oracle::random_pair<D>(random, static_cast<oracle::Kind>(kind_a),
                                                             static_cast<oracle::Kind>(kind_b));
                    const auto answer = closest(pair.a.view, pair.b.view);
                    overlapping += answer.distance <= 0 ? 1 : 0;
                    visit(Case{pair.a, pair.b, answer, tolerance_for(pair.a.solid, pair.b.solid),
                               2 * oracle::rounding_of(answer.on_a) + 2 * oracle::rounding_of(answer.on_b), random});
                }
        EXPECT_GT(overlapping, pairs * 3 / 10);
        EXPECT_LT(overlapping, pairs * 7 / 10);
    }

    static Pose<dimensions> moved_by(const DVec<dimensions>& v) { return {to_float(v)}; }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Laws, Dimensions);

TYPED_TEST(Laws, SwappingAAndBTurnsTheAnswerRound) {
    this->each_case(1000, [](const auto& c) {
        const auto swapped = closest(c.b.view, c.a.view);
        EXPECT_NEAR(swapped.distance, c.answer.distance, c.margin);
        if (std::abs(static_cast<double>(c.answer.distance)) > c.margin) {
            EXPECT_EQ(overlaps(c.a.view, c.b.view), overlaps(c.b.view, c.a.view));
        }
    });
}

TYPED_TEST(Laws, MovingBothByOnePoseChangesNothing) {
    constexpr int D = TypeParam::value;
    this->each_case(2000, [](const auto& c) {
        const double size = oracle::size(c.a.solid) + oracle::size(c.b.solid);
        const Pose<D> pose{to_float(c.random.template direction<D>() * size), c.random.template rotation<D>()};
        const auto moved = closest(at(c.a.view, pose), at(c.b.view, pose));
        EXPECT_NEAR(moved.distance, c.answer.distance, c.margin);
        EXPECT_TRUE(near(pose * c.answer.on_a, pose * c.answer.on_b,
                         std::abs(static_cast<double>(moved.distance)) + c.margin + 2 * c.rounding));
    });
}

TYPED_TEST(Laws, ScalingBothScalesTheDistance) {
    constexpr int D = TypeParam::value;
    this->each_case(3000, [](const auto& c) {
        for (const float factor : {0.25f, 3.0f}) {
            const auto scaled = closest(stretched(c.a.view, Vec<D>(factor)), stretched(c.b.view, Vec<D>(factor)));
            EXPECT_NEAR(scaled.distance / factor, c.answer.distance, c.margin);
        }
    });
}

TYPED_TEST(Laws, RoundingTakesItsRadiusOffTheDistance) {
    this->each_case(4000, [](const auto& c) {
        const float radius = static_cast<float>(oracle::size(c.b.solid) * c.random.uniform(0.01, 1));
        const double expected = static_cast<double>(c.answer.distance) - static_cast<double>(radius);
        EXPECT_NEAR(closest(rounded(c.a.view, radius), c.b.view).distance, expected, 2 * c.margin);
        EXPECT_NEAR(closest(c.a.view, rounded(c.b.view, radius)).distance, expected, 2 * c.margin);
        if (std::abs(expected) > 2 * c.margin) {
            EXPECT_EQ(overlaps(rounded(c.a.view, radius), c.b.view), expected < 0);
        }
    });
}

TYPED_TEST(Laws, OverlapIsADistanceNotAboveZero) {
    this->each_case(5000, [](const auto& c) {
        if (std::abs(static_cast<double>(c.answer.distance)) > c.margin) {
            EXPECT_EQ(overlaps(c.a.view, c.b.view), c.answer.distance <= 0);
        }
    });
}

TYPED_TEST(Laws, MovingBByTheAnswerMakesThemTouch) {
    this->each_case(6000, [this](const auto& c) {
        const auto displacement = DVec<TypeParam::value>(c.answer.normal) * -static_cast<double>(c.answer.distance);
        const auto touching = closest(c.a.view, at(c.b.view, this->moved_by(displacement)));
        // The normal is rounded to floats, which rotates the separating direction by as much.
        EXPECT_NEAR(touching.distance, 0, 2 * c.margin + 2e-7 * length(displacement) + c.rounding);
        if (c.answer.distance < 0) {
            const auto apart = closest(c.a.view, at(c.b.view, this->moved_by(displacement * 1.01)));
            EXPECT_GE(apart.distance,
                      0.009 * length(displacement) - 2 * c.margin - 2e-7 * length(displacement) - c.rounding);
        }
    });
}

TYPED_TEST(Laws, ContainingAPointIsADistanceNotAboveZero) {
    constexpr int D = TypeParam::value;
    int points = 0, inside = 0;
    this->each_case(7000, [&](const auto& c) {
        if (c.a.kind == oracle::Kind::segment || (D == 3 && c.a.kind == oracle::Kind::triangle)) return;
        const DVec<D> center = oracle::middle(c.a.solid);
        const Vec<D> point = to_float(center + c.random.template direction<D>() *
                                                   (oracle::size(c.a.solid) * c.random.uniform(0, D == 2 ? 1.3 : 1)));
        const auto found = closest(c.a.view, point);
        const auto solid = oracle::hull_of<D>({point});
        const double margin = tolerance_for(c.a.solid, solid) + oracle::rounding_of(point);
        EXPECT_NEAR(found.distance, truth(c.a.solid, solid).distance, margin);
        if (std::abs(static_cast<double>(found.distance)) > margin) {
            EXPECT_EQ(contains(c.a.view, point), found.distance <= 0);
        }
        ++points;
        inside += found.distance <= 0 ? 1 : 0;
    });
    EXPECT_GT(inside, points * 3 / 10);
    EXPECT_LT(inside, points * 7 / 10);
}

TYPED_TEST(Laws, TheSameQueryHasTheSameAnswer) {
    this->each_case(8000, [](const auto& c) {
        const auto again = closest(c.a.view, c.b.view);
        EXPECT_EQ(again.distance, c.answer.distance);
        EXPECT_EQ(again.normal, c.answer.normal);
        EXPECT_EQ(again.on_a, c.answer.on_a);
        EXPECT_EQ(again.feature_a, c.answer.feature_a);
    });
}

}  // namespace
}  // namespace abut
