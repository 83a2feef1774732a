#pragma once

// Early out: the order in which to run tests that must all pass, and whether a cheap test before the others pays.
//
//    t_i   cost of test i, in any unit                   p_i   the fraction of its inputs that passes it
//    T     = t_1 + p_1 t_2 + p_1 p_2 t_3 + ...           the cost of a run that ends with the first refusal
//
// Swap two neighbours i, j that a fraction r reaches:     T changes from ... + r (t_i + p_i t_j) + ...
//                                                        to             ... + r (t_j + p_j t_i) + ...
// by r (t_j (1 - p_i) - t_i (1 - p_j)): no swap gains when t_i / (1 - p_i) ascends. The argument is W. E. Smith's,
// "Various optimizers for single-stage production", 1956; the use J. M. Hellerstein's and M. Stonebraker's, "Predicate
// migration", 1993.

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace abut {

/// The cost and pass rate of one test.
struct TestCost {
    double time = 0;  ///< t >= 0, in any unit; may be infinite
    double pass = 1;  ///< p in [0, 1]: the fraction of its inputs that passes
};

/// The cheapest order: indices of `tests` by ascending t / (1 - p), ties by index; a test that never refuses comes
/// last. It has the least expected_cost of all orders if the tests pass independently of each other; of two tests,
/// always. `order` has the size of `tests`. Allocates nothing.
void best_order(std::span<const TestCost> tests, std::span<std::size_t> order);

std::vector<std::size_t> best_order(std::span<const TestCost> tests);

template <std::size_t N>
std::array<std::size_t, N> best_order(const std::array<TestCost, N>& tests) {
    std::array<std::size_t, N> order{};
    best_order(std::span<const TestCost>(tests), std::span<std::size_t>(order));
    return order;
}

/// t_1 + p_1 t_2 + p_1 p_2 t_3 + ...: the average cost of a run in the order given. A test that is never reached costs
/// nothing, not even with infinite time.
double expected_cost(std::span<const TestCost> tests);

/// The expected cost in another order: indices of `tests`.
double expected_cost(std::span<const TestCost> tests, std::span<const std::size_t> order);

/// Whether to run a before b, where a is redundant: it passes all that b passes, such as two bounding spheres before
/// the shapes themselves. Alone, b costs t_b; after a, both cost t_a + p_a t_b.
constexpr bool worth_pretesting(double t_a, double p_a, double t_b) {
    return t_a < (1 - p_a) * t_b;
}

}  // namespace abut

namespace abut::detail {

/// A clock: nanoseconds since some moment, never decreasing.
using NanosecondClock = std::uint64_t (*)();

std::uint64_t steady_nanoseconds();

/// The best order by joint outcomes: outcomes[m] counts the samples in which exactly the tests of the bits of m passed.
void best_order(std::span<const double> times, std::span<const double> outcomes, std::span<std::size_t> order);

/// The costs and pass rates of N tests, from samples: now and then all tests run on the same input, each between two
/// readings of a clock. For callers that run the tests themselves; EarlyOut does it by itself.
///
/// At most one call in 255 is a sample, so that samples take about 1 % of the time; fewer are, if the tests are cheaper
/// than the clock. A count decides, with an odd period, so that it doesn't run in step with the caller's loops.
template <std::size_t N>
class SampledTests {
public:
    static_assert(N >= 1 && N <= 8, "outcomes are counted by which tests passed: 2^N numbers");

    static constexpr double enough = 32;  ///< the number of samples from which the results below are of use

    /// Whether to make a sample of this call. To be called once a call.
    bool due() {
        if (--left_ > 0) return false;
        left_ = period_;
        return true;
    }

    /// Adds a sample. `laps` are readings of the clock: the first measures the clock alone, the others each test by
    /// index. Bit i of `passed` is set if test i passed. `order` is the order of a normal run. A lap of more than 64
    /// times its mean was interrupted, and counts as 64 times its mean.
    void add(std::array<double, N + 1> laps, std::uint32_t passed, std::span<const std::size_t> order) {
        double all = 0, usual = 0;
        for (std::size_t i = 0; i <= N; ++i) {
            const double mean = samples_ < 8 ? 0 : laps_[i] / samples_;
            if (mean > 0 && laps[i] > 64 * mean) laps[i] = 64 * mean;
            laps_[i] += laps[i];
            all += laps[i];
        }
        for (const std::size_t i : order) {
            usual += laps[i + 1] - laps[0];
            if ((passed >> i & 1u) == 0) break;
        }
        outcomes_[passed] += 1;
        samples_ += 1;
        all_ += all;
        usual_ += usual;
        set_period();
    }

    double samples() const { return samples_; }
    std::uint32_t period() const { return period_; }

    /// The cost of one test, whatever the others return; the time of reading the clock is subtracted.
    TestCost cost(std::size_t i) const {
        TestCost result;
        if (samples_ == 0) return result;
        const double time = (laps_[i + 1] - laps_[0]) / samples_;
        result.time = time > 0 ? time : 0;
        double passed = 0;
        for (std::size_t m = 0; m < outcomes_.size(); ++m) passed += (m >> i & 1u) != 0 ? outcomes_[m] : 0;
        result.pass = passed / samples_;
        return result;
    }

    /// Takes the cheapest remaining test each time, by its pass rate among the samples that pass all before it.
    std::array<std::size_t, N> best_order() const {
        std::array<double, N> times{};
        for (std::size_t i = 0; i < N; ++i) times[i] = cost(i).time;
        std::array<std::size_t, N> order{};
        detail::best_order(times, outcomes_, order);
        return order;
    }

    /// Halves the weight of old samples once there are many: a level may change.
    void fade() {
        if (samples_ < 1024) return;
        for (double& lap : laps_) lap /= 2;
        for (double& count : outcomes_) count /= 2;
        samples_ /= 2;
        all_ /= 2;
        usual_ /= 2;
    }

private:
    static constexpr std::uint32_t min_period = 255, max_period = 16383;

    void set_period() {
        const double wanted = usual_ > 0 ? 128 * all_ / usual_ : static_cast<double>(max_period);
        const double within = wanted < static_cast<double>(max_period) ? wanted : static_cast<double>(max_period);
        period_ = within > static_cast<double>(min_period) ? static_cast<std::uint32_t>(within) | 1u : min_period;
    }

    std::array<double, N + 1> laps_{};                    // sums: the clock alone, then each test with the clock
    std::array<double, std::size_t{1} << N> outcomes_{};  // samples, by the bits of the tests that passed
    double samples_ = 0;
    double all_ = 0, usual_ = 0;  // sums: what samples took, and what the same calls would have taken
    std::uint32_t period_ = min_period, left_ = min_period;
};

}  // namespace abut::detail

namespace abut {

/// Several tests as one: true iff all pass, run in the order that refuses at the least cost.
///
///    EarlyOut seen{in_range, in_front, not_hidden};
///    for (...) if (seen.measured(guard, player)) ...    // each frame
///    seen.reorder();                                    // between frames
///
/// A call stops at the first test that returns false. The order is the one given until `reorder` changes it, so it is
/// fixed in between. Every test must be callable as const with the arguments of the call, whatever the other tests
/// return. If the tests are pure, no answer depends on the order, and so none on the clock.
///
/// There are two ways to call it. `all(...)` is const, reads no clock, and may run on many threads at once.
/// `all.measured(...)` gives the same answer and counts; in one call of 255 or more it runs and measures all tests. It
/// is for one thread, where most calls are made. Samples take about 1 % of the time, and counting up to a nanosecond a
/// call: if calls take a few nanoseconds only, use `measured` in one loop of several.
///
/// The formula at the top of this file assumes that tests pass independently of each other. They seldom do: distant
/// objects tend to be small on the screen as well, so the second test gains little after the first. A sample runs all
/// tests on the same input, so `reorder` needn't assume it: it takes the best t / (1 - p) first, then the best of the
/// rest with p among the samples that passed the first, and so on. For independent tests this is best_order; else it
/// costs at most four times the least (S. Babu and others, "Adaptive ordering of pipelined stream filters", 2004).
template <class... Tests>
class EarlyOut {
public:
    static constexpr std::size_t size = sizeof...(Tests);

    explicit EarlyOut(Tests... tests) : tests_(std::move(tests)...) {
        for (std::size_t i = 0; i < size; ++i) order_[i] = i;
    }

    template <class... Arguments>
    requires(std::predicate<const Tests&, const Arguments&...>&&...) bool operator()(
        const Arguments&... arguments) const {
        for (const std::size_t i : order_)
            if (!passes(i, arguments...)) return false;
        return true;
    }

    template <class... Arguments>
    requires(std::predicate<const Tests&, const Arguments&...>&&...) bool measured(const Arguments&... arguments) {
        return sampled_.due() ? sample(arguments...) : (*this)(arguments...);
    }

    /// Puts the tests in the best known order, if 32 samples have been made. To be called between frames, not during
    /// one.
    void reorder() {
        if (sampled_.samples() < detail::SampledTests<size>::enough) return;
        order_ = sampled_.best_order();
        sampled_.fade();
    }

    /// Indices of the tests as given, in the order in which they run.
    const std::array<std::size_t, size>& order() const { return order_; }

    /// The measured cost of test i by itself, in nanoseconds; {0, 1} before the first sample.
    TestCost cost(std::size_t i) const { return sampled_.cost(i); }

    /// Replaces steady_nanoseconds by another clock, in any unit.
    void set_clock(detail::NanosecondClock clock) { clock_ = clock; }

private:
    template <class... Arguments>
    bool passes(std::size_t which, const Arguments&... arguments) const {
        return [&]<std::size_t... I>(std::index_sequence<I...>) {
            bool result = false;
            const auto run_if_selected = [&](const auto& test) {
                result = static_cast<bool>(test(arguments...));
                return true;
            };
            static_cast<void>(((which == I && run_if_selected(std::get<I>(tests_))) || ...));
            return result;
        }
        (std::index_sequence_for<Tests...>());
    }

    template <class... Arguments>
    bool sample(const Arguments&... arguments) {
        std::array<double, size + 1> laps{};
        std::uint64_t last = clock_();
        const auto lap = [&] {
            const std::uint64_t now = clock_();
            return static_cast<double>(now - std::exchange(last, now));
        };
        laps[0] = lap();
        std::uint32_t passed = 0;
        for (const std::size_t i : order_) {
            passed |= (passes(i, arguments...) ? 1u : 0u) << i;
            laps[i + 1] = lap();
        }
        sampled_.add(laps, passed, order_);
        return passed == (1u << size) - 1;
    }

    std::tuple<Tests...> tests_;
    std::array<std::size_t, size> order_{};
    detail::SampledTests<size> sampled_;
    detail::NanosecondClock clock_ = detail::steady_nanoseconds;
};

}  // namespace abut
