// Caches save iterations and change no answer; traces record the steps of a search.

#include "../oracle/check.hpp"
#include "../oracle/pair.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

template <class T>
class SearchOptionsTest : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(SearchOptionsTest, Dimensions);

template <int D>
std::vector<Vec<D>> corners(oracle::Random& random, int count) {
    std::vector<Vec<D>> result;
    for (int i = 0; i < count; ++i) result.push_back(to_float(random.direction<D>()));
    return result;
}

template <int D>
std::size_t steps_of_gjk(const Trace<D>& trace) {
    std::size_t result = 0;
    for (const TraceStep<D>& step : trace.steps) result += std::holds_alternative<GjkStep<D>>(step) ? 1 : 0;
    return result;
}

TYPED_TEST(SearchOptionsTest, ACacheSavesSteps) {
    constexpr int D = TypeParam::value;
    oracle::Random random(1);
    const auto a = *oracle::BuiltHull<D>::build(corners<D>(random, 40));
    const auto b = *oracle::BuiltHull<D>::build(corners<D>(random, 40));
    Cache cache;
    std::size_t warm = 0, cold = 0;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        Vec<D> position(0);
        position[0] = 2.5f;
        position[1] = -1 + 0.01f * static_cast<float>(i);
        const auto moved = at(b, Pose<D>{position});
        Trace<D> with, without;
        const auto cached = closest(a, moved, {.cache = &cache, .trace = &with});
        const auto fresh = closest(a, moved, {.trace = &without});
        EXPECT_NEAR(cached.distance, fresh.distance, 1e-6);
        EXPECT_TRUE(certify(a, moved, cached));
        warm += steps_of_gjk(with);
        cold += steps_of_gjk(without);
    }
    EXPECT_LT(2 * warm, cold);
    EXPECT_GT(cache.count, 0u);
}

TYPED_TEST(SearchOptionsTest, ACacheOfAnotherPairDoesNoHarm) {
    constexpr int D = TypeParam::value;
    Cache cache;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(4000)); ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const auto kind = [&] { return static_cast<oracle::Kind>(random.below(oracle::kind_count)); };
        const oracle::Kind kind_a = kind(), kind_b = kind();
        const auto pair = oracle::random_pair<D>(random, kind_a, kind_b);
        const double margin = tolerance_for(pair.a.solid, pair.b.solid);
        if (random.chance(0.2)) {
            for (auto& corner : cache.corner_a) corner = random.below(20);
            for (auto& corner : cache.corner_b) corner = random.below(20);
            for (float& x : cache.axis) x = random.uniform_float(-1, 1);
            cache.count = random.below(8);
        }
        const auto cached = closest(pair.a.view, pair.b.view, {.cache = &cache});
        const double truth = oracle::truth(pair.a.solid, pair.b.solid).distance;
        EXPECT_NEAR(cached.distance, truth, margin);
        EXPECT_TRUE(certify(pair.a.view, pair.b.view, cached));
        if (std::abs(truth) > margin) {
            EXPECT_EQ(overlaps(pair.a.view, pair.b.view, {.cache = &cache}), truth <= 0);
        }
    }
}

TYPED_TEST(SearchOptionsTest, ATraceChangesNothing) {
    constexpr int D = TypeParam::value;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const auto kind = [&] { return static_cast<oracle::Kind>(random.below(oracle::kind_count)); };
        const oracle::Kind kind_a = kind(), kind_b = kind();
        const auto pair = oracle::random_pair<D>(random, kind_a, kind_b);
        Trace<D> trace;
        const auto traced = closest(pair.a.view, pair.b.view, {.trace = &trace});
        const auto plain = closest(pair.a.view, pair.b.view);
        EXPECT_EQ(traced.distance, plain.distance);
        EXPECT_EQ(traced.normal, plain.normal);
        EXPECT_EQ(traced.on_a, plain.on_a);
        EXPECT_EQ(contact(pair.a.view, pair.b.view, {.trace = &trace}).depth, contact(pair.a.view, pair.b.view).depth);
    }
}

TEST(Trace, TraceHasEachKindOfStep) {
    const auto tilted = at(Box3{{0, 0, 0}, {1, 1, 1}}, Pose3{{0.5f, 0.25f, 1.75f}, glm::quat(0.9f, 0.1f, 0.2f, 0.3f)});
    const Box3 box{{0, 0, 0}, {2, 2, 1}};
    Trace<3> trace;
    const auto touch = contact(box, tilted, {.trace = &trace});
    ASSERT_TRUE(touch);
    std::size_t axes = 0, cuts = 0;
    float least = std::numeric_limits<float>::infinity();
    for (const TraceStep<3>& step : trace.steps) {
        if (const auto* axis = std::get_if<AxisStep<3>>(&step)) {
            ++axes;
            least = std::min(least, -axis->gap());
        }
        cuts += std::holds_alternative<ClipStep<3>>(step) ? 1 : 0;
    }
    EXPECT_GE(axes, 15u);
    EXPECT_FLOAT_EQ(least, touch.depth);
    EXPECT_GT(cuts, 0u);

    trace.clear();
    oracle::Random random(3);
    const Polyhedron hull = *Polyhedron::build(corners<3>(random, 20));
    const auto deep = closest(hull, at(hull, Pose3{{0.5f, 0, 0}}), {.trace = &trace});
    const auto& last = std::get<PenetrationStep<3>>(trace.steps.back());
    EXPECT_FLOAT_EQ(last.extent, -deep.distance);
    EXPECT_NEAR(last.distance, last.extent, 1e-5);
    EXPECT_GT(steps_of_gjk(trace), 1u);
}

}  // namespace
}  // namespace abut
