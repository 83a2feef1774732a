// Orders against all permutations, and measured conjunctions against a simulated clock.

#include "../oracle/random.hpp"
#include <abut/query/early_out.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using Order = std::vector<std::size_t>;
using Costs = std::vector<TestCost>;

constexpr double infinity = std::numeric_limits<double>::infinity();

Order identity(std::size_t count) {
    Order result(count);
    std::iota(result.begin(), result.end(), std::size_t{0});
    return result;
}

/// The minimum of cost(order) over all orders.
template <class Cost>
double least_over_permutations(std::size_t count, Cost&& cost) {
    Order order = identity(count);
    double least = infinity;
    do least = std::min(least, cost(order));
    while (std::next_permutation(order.begin(), order.end()));
    return least;
}

// --- the arithmetic
// ------------------------------------------------------------------------------------------------------

TEST(EarlyOut, OrderAndCostInClosedForm) {
    // t / (1 - p) = 4, 2, 5.
    const std::array<TestCost, 3> tests{{{3, 0.25}, {1, 0.5}, {1, 0.8}}};
    EXPECT_EQ(best_order(tests), (std::array<std::size_t, 3>{1, 0, 2}));
    EXPECT_DOUBLE_EQ(expected_cost(tests), 3 + 0.25 * 1 + 0.25 * 0.5 * 1);
    EXPECT_DOUBLE_EQ(expected_cost(tests, best_order(tests)), 1 + 0.5 * 3 + 0.5 * 0.25 * 1);
    EXPECT_EQ(expected_cost({}), 0);
    EXPECT_TRUE(best_order(std::span<const TestCost>()).empty());
}

TEST(EarlyOut, WhatNeverRefusesIsLastAndTiesStayInPlace) {
    EXPECT_EQ(best_order(Costs{{0, 1}, {5, 0}, {1, 1}, {infinity, 0.5}, {5, 0}, {10, 0.5}}),
              (Order{1, 4, 5, 0, 2, 3}) /* 5 + 0: nothing gets past the first */);
    EXPECT_EQ(best_order(Costs(5, {3, 0.5})), identity(5));
    EXPECT_EQ(best_order(Costs(5, {3, 1})), identity(5));
    EXPECT_EQ(best_order(Costs{{1, 0.5}, {0, 0.9}}), (Order{1, 0})) << "a test without cost is first";
}

TEST(EarlyOut, WhatIsNeverReachedCostsNothing) {
    EXPECT_EQ(expected_cost(Costs{{2, 0}, {infinity, 0.5}}), 2);
    EXPECT_EQ(expected_cost(Costs{{infinity, 0.5}, {2, 0}}), infinity);
    EXPECT_EQ(best_order(Costs{{infinity, 0}, {2, 0}}), (Order{1, 0}));
}

double any_time(oracle::Random& random, int kind) {
    constexpr std::array<double, 8> extremes{0, 1, 1, 2, 1e-300, 1e300, infinity, 0};
    if (kind == 0) return random.uniform(0, 10);
    return kind == 1 ? static_cast<double>(1 + random.below(3)) : extremes[random.below(8)];
}

double any_pass(oracle::Random& random, int kind) {
    constexpr std::array<double, 8> extremes{0, 1, 0.5, 1e-300, 1 - 0x1p-53, 0x1p-60, 1, 0};
    if (kind == 0) return random.unit();
    return kind == 1 ? 0.25 * static_cast<double>(random.below(5)) : extremes[random.below(8)];
}

TEST(EarlyOut, BestOrderCostsTheLeastOfAllPermutations) {
    int improved = 0;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        oracle::Random random(seed);
        const std::size_t count = seed < 60 ? 7 : 1 + seed % 6;
        const int kind = static_cast<int>(seed / 7 % 3);  // random numbers, few distinct numbers (ties), extremes
        Costs tests;
        for (std::size_t i = 0; i < count; ++i) tests.push_back({any_time(random, kind), any_pass(random, kind)});
        const Order order = best_order(tests);
        Order sorted = order;
        std::sort(sorted.begin(), sorted.end());
        ASSERT_EQ(sorted, identity(count));
        const double found = expected_cost(tests, order);
        const double least =
            least_over_permutations(count, [&](const Order& each) { return expected_cost(tests, each); });
        EXPECT_LE(found, least * (1 + 1e-12));
        Costs reordered;
        for (const std::size_t i : order) reordered.push_back(tests[i]);
        EXPECT_EQ(expected_cost(reordered), found);
        improved += found < expected_cost(tests) ? 1 : 0;
    }
    EXPECT_GT(improved, 300);
}

TEST(EarlyOut, CheapTestPaysWhereItsCostIsLess) {
    static_assert(worth_pretesting(1, 0.5, 3) && !worth_pretesting(1, 0.5, 2) && !worth_pretesting(1, 0.5, 1.5));
    EXPECT_FALSE(worth_pretesting(0, 1, 100));
    EXPECT_FALSE(worth_pretesting(0, 1, infinity));
    EXPECT_TRUE(worth_pretesting(5, 0.5, infinity));
    EXPECT_FALSE(worth_pretesting(infinity, 0, infinity));
    oracle::Random random(1);
    int worth = 0;
    for (int i = 0; i < 1000; ++i) {
        // Powers of two: no sum is rounded.
        const double t_a = random.below(16), p_a = random.below(17) / 16.0, t_b = random.below(32);
        EXPECT_EQ(worth_pretesting(t_a, p_a, t_b), t_a + p_a * t_b < t_b);
        worth += worth_pretesting(t_a, p_a, t_b) ? 1 : 0;
    }
    EXPECT_GT(worth, 200);
    EXPECT_LT(worth, 800);
}

// --- what is measured
// ----------------------------------------------------------------------------------------------------

/// The mean cost of a run, if exactly the tests of m pass outcomes[m] times.
double joint_cost(const Order& order, const std::vector<double>& times, const std::vector<double>& outcomes) {
    double cost = 0, all = 0;
    for (std::size_t m = 0; m < outcomes.size(); ++m) {
        all += outcomes[m];
        for (const std::size_t i : order) {
            cost += outcomes[m] * times[i];
            if ((m >> i & 1u) == 0) break;
        }
    }
    return cost / all;
}

template <std::size_t N>
detail::SampledTests<N> sampled(const std::vector<double>& times, const std::vector<double>& outcomes) {
    detail::SampledTests<N> result;
    std::array<double, N + 1> laps{};
    laps[0] = 20;  // the clock's own time
    for (std::size_t i = 0; i < N; ++i) laps[i + 1] = 20 + times[i];
    for (std::size_t m = 0; m < outcomes.size(); ++m)
        for (int k = 0; k < static_cast<int>(outcomes[m]); ++k)
            result.add(laps, static_cast<std::uint32_t>(m), identity(N));
    return result;
}

template <std::size_t N>
void expect_greedy_is_good(std::uint64_t seed, double factor) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracle::Random random(seed);
    std::vector<double> times, outcomes;
    for (std::size_t i = 0; i < N; ++i) times.push_back(1 + random.below(9));
    for (std::size_t m = 0; m < std::size_t{1} << N; ++m) outcomes.push_back(random.chance(0.5) ? 0 : random.below(20));
    outcomes[0] += 1;
    const auto tests = sampled<N>(times, outcomes);
    const auto order = tests.best_order();
    const double found = joint_cost({order.begin(), order.end()}, times, outcomes);
    const double least =
        least_over_permutations(N, [&](const Order& each) { return joint_cost(each, times, outcomes); });
    EXPECT_LE(found, factor * least * (1 + 1e-12));
}

TEST(SampledTests, OrderOfTestsThatDependOnOneAnother) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        expect_greedy_is_good<2>(seed, 1);
        expect_greedy_is_good<3>(seed, 1.5);
        expect_greedy_is_good<5>(seed, 4);
    }
}

// Dependent tests: far things are small. Each test alone rejects much; the second rejects nothing that passed the
// first.
TEST(SampledTests, RepeatedTestComesLast) {
    // 0 and 1 pass the same half; 2 passes three quarters of either half.
    std::vector<double> outcomes(8, 0);
    outcomes[0b000] = 10;
    outcomes[0b100] = 30;
    outcomes[0b011] = 10;
    outcomes[0b111] = 30;
    const std::vector<double> times{1, 1.5, 2};
    const auto tests = sampled<3>(times, outcomes);
    EXPECT_EQ(tests.best_order(), (std::array<std::size_t, 3>{0, 2, 1}));
    const std::array<TestCost, 3> alone{tests.cost(0), tests.cost(1), tests.cost(2)};
    EXPECT_EQ(best_order(alone), (std::array<std::size_t, 3>{0, 1, 2}));
}

TEST(SampledTests, IndependentTestsComeInBestOrder) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        oracle::Random random(seed);
        std::vector<double> times, outcomes(16, 1);
        for (std::size_t i = 0; i < 4; ++i) {
            times.push_back(random.below(9));
            const std::uint32_t quarters = random.below(5);
            for (std::size_t m = 0; m < 16; ++m) outcomes[m] *= (m >> i & 1u) != 0 ? quarters : 4 - quarters;
        }
        const auto tests = sampled<4>(times, outcomes);
        std::array<TestCost, 4> costs;
        for (std::size_t i = 0; i < 4; ++i) costs[i] = tests.cost(i);
        EXPECT_EQ(tests.best_order(), best_order(costs));
        for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(costs[i].time, times[i]) << "without the clock's own time";
    }
}

// --- EarlyOut
// ------------------------------------------------------------------------------------------------------------

std::uint64_t now = 0;
std::uint64_t clock_reads = 0;

/// A simulated clock; reading it takes time.
std::uint64_t counting_clock() {
    ++clock_reads;
    now += 12;
    const std::uint64_t result = now;
    now += 13;
    return result;
}

/// A test that passes a fraction of all numbers and takes a simulated time.
struct Slow {
    std::uint64_t time = 1;
    double pass = 1;
    std::uint64_t key = 0;

    bool operator()(std::uint64_t number) const {
        now += time;
        return oracle::Random(number + key).unit() < pass;
    }
};

bool passes(const Slow& test, std::uint64_t number) {
    return oracle::Random(number + test.key).unit() < test.pass;
}

/// The time of `count` measured calls, including the clock's.
template <class All>
double time_of(All& all, std::uint64_t calls) {
    const std::uint64_t before = now;
    for (std::uint64_t i = 0; i < calls; ++i) all.measured(i);
    return static_cast<double>(now - before) / static_cast<double>(calls);
}

TEST(EarlyOut, IsTheConjunctionInAnyOrder) {
    const Slow a{1, 0.6, 1u << 20}, b{3, 0.7, 2u << 20}, c{2, 0.5, 3u << 20}, d{90, 0.9, 4u << 20};
    EarlyOut all{d, a, b, c};
    all.set_clock(counting_clock);
    int passed = 0, reorders = 0;
    for (std::uint64_t i = 0; i < 30000; ++i) {
        const bool expected = passes(a, i) && passes(b, i) && passes(c, i) && passes(d, i);
        ASSERT_EQ(all(i), expected);
        ASSERT_EQ(all.measured(i), expected);
        passed += expected ? 1 : 0;
        if (i % 1000 != 999) continue;
        const auto before = all.order();
        all.reorder();
        reorders += all.order() != before ? 1 : 0;
    }
    EXPECT_GT(passed, 4000);
    EXPECT_GT(reorders, 0);
    EXPECT_EQ(all.order()[3], 0u) << "the slow one that refuses little";
}

TEST(EarlyOut, StopsAtTheFirstRefusal) {
    std::string calls_made;
    const auto test = [&calls_made](char name, bool answer) {
        return [&calls_made, name, answer](int) {
            calls_made += name;
            return answer;
        };
    };
    const EarlyOut all{test('a', true), test('b', false), test('c', true)};
    EXPECT_FALSE(all(1));
    EXPECT_EQ(calls_made, "ab");
    const EarlyOut one{test('z', true)};
    EXPECT_TRUE(one(1));
    EXPECT_EQ(calls_made, "abz");
}

TEST(EarlyOut, TakesAnyArgumentsWithoutCopies) {
    struct Fixed {
        explicit Fixed(int v) : value(v) {}
        Fixed(const Fixed&) = delete;
        int value;
    };
    EarlyOut all{[](const Fixed& a, const Fixed& b) { return a.value < b.value; },
                 [](const Fixed& a, const Fixed&) { return a.value > 0; }};
    EXPECT_TRUE(all(Fixed(1), Fixed(2)));
    EXPECT_FALSE(all.measured(Fixed(0), Fixed(2)));
    EXPECT_FALSE(all(Fixed(3), Fixed(2)));
    static_assert(std::is_invocable_v<const decltype(all)&, const Fixed&, const Fixed&>);
    static_assert(!std::is_invocable_v<const decltype(all)&, int>);
}

TEST(EarlyOut, ComesToTheBestOrderAndKeepsItWithinAFrame) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        oracle::Random random(seed);
        // The ranks differ by a factor of 2, because the measurements are not exact.
        std::array<Slow, 4> tests;
        std::array<TestCost, 4> costs;
        const std::size_t first = random.below(4);
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t i = (first + k) % 4;
            const double pass = random.uniform(0.2, 0.7), time = 20 * std::ldexp(1.0, static_cast<int>(k)) * (1 - pass);
            tests[i] = {static_cast<std::uint64_t>(time) + 1, pass, (i + 1) << 30};
            costs[i] = {static_cast<double>(tests[i].time), pass};
        }
        EarlyOut all{tests[0], tests[1], tests[2], tests[3]};
        all.set_clock(counting_clock);
        all.reorder();
        EXPECT_EQ(all.order(), (std::array<std::size_t, 4>{0, 1, 2, 3})) << "nothing is known yet";
        time_of(all, 200000);
        EXPECT_EQ(all.order(), (std::array<std::size_t, 4>{0, 1, 2, 3})) << "only after reorder()";
        all.reorder();
        EXPECT_EQ(all.order(), best_order(costs));
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_DOUBLE_EQ(all.cost(i).time, costs[i].time);
            EXPECT_NEAR(all.cost(i).pass, costs[i].pass, 0.1);
        }
        EXPECT_NEAR(time_of(all, 20000), expected_cost(costs, best_order(costs)),
                    0.04 * expected_cost(costs, best_order(costs)));
    }
}

TEST(EarlyOut, FollowsWhatChanges) {
    double pass_a = 0.1, pass_b = 0.9;
    const auto test = [](const double& pass, std::uint64_t key) {
        return [&pass, key](std::uint64_t number) {
            now += 50;
            return oracle::Random(number + key).unit() < pass;
        };
    };
    EarlyOut all{test(pass_a, 1u << 20), test(pass_b, 1u << 30)};
    all.set_clock(counting_clock);
    for (int frame = 0; frame < 100; ++frame) {
        time_of(all, 20000);
        all.reorder();
    }
    EXPECT_EQ(all.order()[0], 0u);
    std::swap(pass_a, pass_b);
    for (int frame = 0; frame < 30; ++frame) {
        time_of(all, 20000);
        all.reorder();
    }
    EXPECT_EQ(all.order()[0], 1u);
}

TEST(EarlyOut, MeasuringIsCheap) {
    const auto expect_cheap = [](auto all, double usual) {
        SCOPED_TRACE("usual cost " + std::to_string(usual));
        all.set_clock(counting_clock);
        clock_reads = 0;
        time_of(all, 100000);  // adapts the sampling rate
        EXPECT_GT(clock_reads, 0u);
        EXPECT_LT(clock_reads, 100000u / 32);
        EXPECT_LT(time_of(all, 1000000), 1.02 * usual);
    };
    // All tests pass, which gives the time of a call without a sample.
    expect_cheap(EarlyOut{Slow{1}}, 1);
    expect_cheap(EarlyOut{Slow{1}, Slow{2}}, 3);
    expect_cheap(EarlyOut{Slow{2}, Slow{200}, Slow{3}}, 205);
    expect_cheap(EarlyOut{Slow{1000}, Slow{1000}, Slow{1000}, Slow{1000}}, 4000);
    // The first test rejects all, and a sample runs the others as well.
    expect_cheap(EarlyOut{Slow{10, 0}, Slow{400}, Slow{50}}, 10);
}

TEST(EarlyOut, ConstCallsLookAtNoClock) {
    EarlyOut all{Slow{1}, Slow{2}};
    all.set_clock(counting_clock);
    clock_reads = 0;
    for (std::uint64_t i = 0; i < 10000; ++i) static_cast<void>(std::as_const(all)(i));
    EXPECT_EQ(clock_reads, 0u);
    time_of(all, 10000);
    EXPECT_GT(clock_reads, 0u);
}

TEST(EarlyOut, InterruptedSampleDoesNotUpsetTheOrder) {
    std::uint64_t calls = 0;
    const auto quick = [&calls](std::uint64_t number) {
        now += ++calls % 200 == 150 ? 1000000 : 10;  // of its calls; of those in samples, one in 200 as well
        return oracle::Random(number).chance(0.5);
    };
    EarlyOut all{Slow{100, 0.5, 1u << 20}, quick};
    all.set_clock(counting_clock);
    for (std::uint64_t i = 0; i < 300000; ++i) all.measured(i);
    all.reorder();
    EXPECT_EQ(all.order()[0], 1u) << all.cost(0).time << " " << all.cost(1).time;
}

TEST(EarlyOut, SteadyClockNeverGoesBack) {
    std::uint64_t last = detail::steady_nanoseconds();
    for (int i = 0; i < 1000; ++i) {
        const std::uint64_t next = detail::steady_nanoseconds();
        EXPECT_GE(next, last);
        last = next;
    }
}

}  // namespace
}  // namespace abut::test
