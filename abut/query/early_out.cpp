#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/query/early_out.hpp>

#include <chrono>

namespace abut {
namespace {

/// t / (1 - p); infinite for a test that never refuses.
double rank(const TestCost& test) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double result = test.time / (1 - test.pass);
    return result < infinity ? result : infinity;
}

[[maybe_unused]] bool is_cost(const TestCost& test) {
    return test.time >= 0 && test.pass >= 0 && test.pass <= 1;
}

/// The expected cost of a run so far.
struct Run {
    double cost = 0, reached = 1;

    void add(const TestCost& test) {
        ABUT_ASSERT(is_cost(test));
        if (reached > 0) cost += reached * test.time;
        reached *= test.pass;
    }
};

/// The number of samples that passed all the tests of `mask`.
double passed_all(std::span<const double> outcomes, std::size_t mask) {
    double result = 0;
    for (std::size_t m = 0; m < outcomes.size(); ++m) result += (m & mask) == mask ? outcomes[m] : 0;
    return result;
}

}  // namespace

void best_order(std::span<const TestCost> tests, std::span<std::size_t> order) {
    detail::enter_library();
    ABUT_ASSERT(order.size() == tests.size());
    for (std::size_t i = 0; i < tests.size(); ++i) {
        ABUT_ASSERT(is_cost(tests[i]));
        std::size_t place = i;
        for (; place > 0 && rank(tests[i]) < rank(tests[order[place - 1]]); --place) order[place] = order[place - 1];
        order[place] = i;
    }
}

std::vector<std::size_t> best_order(std::span<const TestCost> tests) {
    std::vector<std::size_t> order(tests.size());
    best_order(tests, order);
    return order;
}

double expected_cost(std::span<const TestCost> tests) {
    detail::enter_library();
    Run run;
    for (const TestCost& test : tests) run.add(test);
    return run.cost;
}

double expected_cost(std::span<const TestCost> tests, std::span<const std::size_t> order) {
    detail::enter_library();
    Run run;
    for (const std::size_t i : order) run.add(tests[i]);
    return run.cost;
}

}  // namespace abut

namespace abut::detail {

std::uint64_t steady_nanoseconds() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count());
}

void best_order(std::span<const double> times, std::span<const double> outcomes, std::span<std::size_t> order) {
    std::size_t before = 0;
    for (std::size_t place = 0; place < times.size(); ++place) {
        // A test that no sample has reached is judged by itself.
        const std::size_t given = passed_all(outcomes, before) > 0 ? before : 0;
        const double reached = passed_all(outcomes, given);
        std::size_t best = times.size();
        double lowest = 0;
        for (std::size_t i = 0; i < times.size(); ++i) {
            const std::size_t bit = std::size_t{1} << i;
            if ((before & bit) != 0) continue;
            const double pass = reached > 0 ? passed_all(outcomes, given | bit) / reached : 1;
            const double ranked = rank({times[i], pass});
            if (best == times.size() || ranked < lowest) {
                best = i;
                lowest = ranked;
            }
        }
        order[place] = best;
        before |= std::size_t{1} << best;
    }
}

}  // namespace abut::detail
