#pragma once

// Quick to refuse: in what order to run tests that must all pass, and whether a cheap one is worth asking first.
//
//     t_i   what test i costs, in any unit                p_i   the fraction of what it sees that it lets pass
//     T     = t_1 + p_1 t_2 + p_1 p_2 t_3 + ...           the cost of a run that ends with the first refusal
//
// Swap two neighbours i, j that a fraction r gets to:     T changes from ... + r (t_i + p_i t_j) + ...
//                                                         to             ... + r (t_j + p_j t_i) + ...
// by r (t_j (1 - p_i) - t_i (1 - p_j)): no gain is left when t_i / (1 - p_i) ascends. W. E. Smith, "Various optimizers
// for single-stage production", 1956, has the argument; J. M. Hellerstein and M. Stonebraker, "Predicate migration",
// 1993, the use.

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

/// Of one test.
struct TestCost {
    double time = 0;  ///< t >= 0, in any unit; may be infinite
    double pass = 1;  ///< p in [0, 1]: how much of what it is asked about it lets pass
};

/// The cheapest order: indices of `tests` by ascending t / (1 - p), ties by index; what never refuses comes last.
/// The least expected_cost of all orders where the tests pass independently of one another; of two tests, always.
/// `order` has room for as many. Allocates nothing.
void best_order(std::span<const TestCost> tests, std::span<std::size_t> order);

std::vector<std::size_t> best_order(std::span<const TestCost> tests);

template <std::size_t N>
std::array<std::size_t, N> best_order(const std::array<TestCost, N>& tests) {
    std::array<std::size_t, N> order{};
    best_order(std::span<const TestCost>(tests), std::span<std::size_t>(order));
    return order;
}

/// t_1 + p_1 t_2 + p_1 p_2 t_3 + ...: what one run costs on average, in the order given. A test that nothing gets to
/// costs nothing, not even an infinite one.
double expected_cost(std::span<const TestCost> tests);

/// The same, in another order: indices of `tests`.
double expected_cost(std::span<const TestCost> tests, std::span<const std::size_t> order);

/// Whether to ask a before b, where a is redundant: it lets everything pass that b does, such as two bounding spheres
/// before the shapes themselves. Alone, b costs t_b; after a, both cost t_a + p_a t_b.
constexpr bool worth_pretesting(double t_a, double p_a, double t_b) {
    return t_a < (1 - p_a) * t_b;
}

/// A clock: nanoseconds since some moment, never going back.
using NanosecondClock = std::uint64_t (*)();

std::uint64_t steady_nanoseconds();

namespace detail {

/// As best_order, by what was seen together: outcomes[m] counts the samples in which exactly the tests of the bits of m
/// passed.
void best_order(std::span<const double> times, std::span<const double> outcomes, std::span<std::size_t> order);

}  // namespace detail

/// What N tests cost and how often they pass, from samples: now and then all of them are run on the same thing, each
/// between two looks at a clock. For those who run tests in a way of their own; EarlyOut does it by itself.
///
/// One call in 255 is a sample, or fewer, so that samples take about 1 % of the time: where the tests are cheaper than
/// the clock. It is chosen by counting, an odd number so as not to walk in step with the caller's loops.
template <std::size_t N>
class SampledTests {
public:
    static_assert(N >= 1 && N <= 8, "outcomes are counted by which tests passed: 2^N numbers");

    static constexpr double enough = 32;  ///< so many samples, for what is said below to be of use

    /// Whether to make a sample of this call. Called once a call.
    bool due() {
        if (--left_ > 0) return false;
        left_ = period_;
        return true;
    }

    /// A sample: `laps` are times as the clock told them, the first with nothing in it but the clock, then of each
    /// test by index; bit i of `passed` is set where test i passed; `order` is what runs when it's no sample.
    /// A lap that takes 64 times its mean was interrupted, and counts as no more than that.
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

    /// Of one test, whatever the others say of the same thing; the time of reading the clock is taken off.
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

    /// Always the cheapest of what is left, its fraction taken among the samples that pass all before it.
    std::array<std::size_t, N> best_order() const {
        std::array<double, N> times{};
        for (std::size_t i = 0; i < N; ++i) times[i] = cost(i).time;
        std::array<std::size_t, N> order{};
        detail::best_order(times, outcomes_, order);
        return order;
    }

    /// Lets old samples weigh less, once there are many: what was true at the start of a level may not stay so.
    void fade() {
        if (samples_ < 1024) return;
        for (double& lap : laps_) lap /= 2;
        for (double& count : outcomes_) count /= 2;
        samples_ /= 2;
        all_ /= 2;
        usual_ /= 2;
    }

private:
    static constexpr std::uint32_t least_period = 255, most_period = 16383;

    void set_period() {
        const double wanted = usual_ > 0 ? 128 * all_ / usual_ : static_cast<double>(most_period);
        const double within = wanted < static_cast<double>(most_period) ? wanted : static_cast<double>(most_period);
        period_ = within > static_cast<double>(least_period) ? static_cast<std::uint32_t>(within) | 1u : least_period;
    }

    std::array<double, N + 1> laps_{};                    // sums: the clock alone, then each test with the clock
    std::array<double, std::size_t{1} << N> outcomes_{};  // samples, by the bits of the tests that passed
    double samples_ = 0;
    double all_ = 0, usual_ = 0;  // sums: what samples took, and what the same calls would have taken
    std::uint32_t period_ = least_period, left_ = least_period;
};

/// Several tests as one: true iff all pass, asked in the order that refuses at the least cost.
///
///     EarlyOut seen{in_range, in_front, not_hidden};
///     for (...) if (seen.measured(guard, player)) ...    // each frame
///     seen.reorder();                                    // between frames
///
/// A call stops at the first test that says no. The order is the one given until `reorder` changes it, so it is fixed
/// in between. Every test must be callable as const with all that the whole is called with, whatever the others say of
/// it; where the tests are pure, no answer depends on the order, and so none on the clock.
///
/// Two ways to call it. `all(...)` is const, looks at no clock, and may run on many threads at once.
/// `all.measured(...)` gives the same answer and counts, and in one call of 255 or more it runs all the tests and
/// measures each: for one thread, where most calls are made. Samples take about 1 % of the time, and counting up to a
/// nanosecond a call: where calls take but a few nanoseconds, use `measured` in one loop of several.
///
/// The formula at the top of this file takes it that tests pass independently of one another. They seldom do: what is
/// far away tends to be small on the screen as well, and then asking the second gains little after the first. As a
/// sample runs all tests on the same thing, `reorder` needn't assume it: it takes the best t / (1 - p) first, then the
/// best of the rest with p among the samples that passed the first, and so on. Where the tests are independent this is
/// best_order; else it costs at most four times the least (S. Babu and others, "Adaptive ordering of pipelined stream
/// filters", 2004).
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

    /// Puts the tests in the best order known, if 32 samples have been made; between frames, not during one.
    void reorder() {
        if (sampled_.samples() < SampledTests<size>::enough) return;
        order_ = sampled_.best_order();
        sampled_.fade();
    }

    /// Indices of the tests as they were given, in the order in which they are asked.
    const std::array<std::size_t, size>& order() const { return order_; }

    /// What was measured of test i by itself, in nanoseconds; {0, 1} before the first sample.
    TestCost cost(std::size_t i) const { return sampled_.cost(i); }

    /// Another clock than steady_nanoseconds, in any unit.
    void set_clock(NanosecondClock clock) { clock_ = clock; }

private:
    template <class... Arguments>
    bool passes(std::size_t which, const Arguments&... arguments) const {
        return [&]<std::size_t... I>(std::index_sequence<I...>) {
            bool result = false;
            const auto ask = [&](const auto& test) {
                result = static_cast<bool>(test(arguments...));
                return true;
            };
            static_cast<void>(((which == I && ask(std::get<I>(tests_))) || ...));
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
    SampledTests<size> sampled_;
    NanosecondClock clock_ = steady_nanoseconds;
};

}  // namespace abut
