#include "measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include <benchmark/benchmark.h>

namespace abut::bench {

namespace {

constexpr int repetitions = 25;
constexpr double seconds_each = 0.008;     // minimum per repetition; a longer call is made once
constexpr double seconds_of_frames = 0.3;  // approximate total per side: long frames have fewer repetitions
constexpr double seconds_of_calls = 1;     // approximate total per side for long calls; at least three are made

struct Answers {
    std::vector<double> values;
    double seconds;  ///< approximate time per call
};

Answers answers(const Side& side, const Job& job) {
    Answers result{std::vector<double>(job.rounds * job.values), 0};
    for (std::size_t round = 0; round < job.rounds; ++round) {
        if (side.prepare) side.prepare();
        const auto begin = std::chrono::steady_clock::now();
        side.run(std::span(result.values).subspan(round * job.values, job.values));
        result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    return result;
}

/// The frames per repetition, and the repetitions, by the time per call.
struct Effort {
    Effort(double seconds, std::size_t wanted_frames)
        : frames(seconds > too_long ? 2 : static_cast<int>(wanted_frames)),
          repetitions(static_cast<int>(std::clamp(seconds_of_frames / (seconds * frames), 1.0, max_repetitions))) {}

    int frames, repetitions;

private:
    static constexpr double too_long = 0.5;
    static constexpr double max_repetitions = abut::bench::repetitions;
};

/// Compares a side's values with abut's.
void compare(const std::vector<double>& ours, const std::vector<double>& theirs, double tolerance, double strays,
             Row& row) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = ours.size(); i-- > 0;) {
        if (std::abs(ours[i] - theirs[i]) <= tolerance) continue;  // written so that NaN differs
        ++count;
        first = i;
    }
    if (count == 0) return;
    std::ostringstream out;
    out << count << " of " << ours.size() << " differ, as number " << first << ": " << theirs[first] << ", abut says "
        << ours[first];
    row.difference = out.str();
    row.agrees = static_cast<double>(count) <= strays * static_cast<double>(ours.size());
}

double median(std::vector<double> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

double mean(const std::vector<double>& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

/// Stores the time per call of every repetition, by the side's index in the benchmark's name.
class Collector : public benchmark::BenchmarkReporter {
public:
    Collector(std::size_t sides, bool on_the_wall) : times_(sides), on_the_wall_(on_the_wall) {}

    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs)
            if (run.run_type == Run::RT_Iteration)
                times_[std::stoul(run.run_name.function_name)].push_back(
                    (on_the_wall_ ? run.real_accumulated_time : run.cpu_accumulated_time) /
                    static_cast<double>(run.iterations));
    }

    /// Seconds per call, one for each repetition.
    const std::vector<double>& times(std::size_t side) const { return times_[side]; }

private:
    std::vector<std::vector<double>> times_;
    bool on_the_wall_;
};

void time_calls(benchmark::State& state, const Side& side, std::size_t value_count) {
    std::vector<double> values(value_count);
    for (auto _ : state) {
        if (side.prepare) {
            state.PauseTiming();
            side.prepare();
            state.ResumeTiming();
        }
        side.run(values);
        benchmark::ClobberMemory();
    }
}

}  // namespace

std::vector<Row> measure(const Bench& bench) {
    const Job job = bench.make();

    std::vector<Row> rows;
    std::vector<double> ours, seconds_a_call;
    for (const Side& side : job.sides) {
        const auto [values, seconds] = answers(side, job);
        seconds_a_call.push_back(seconds);
        if (rows.empty()) ours = values;
        Row& row = rows.emplace_back();
        row.bench = bench.name;
        row.who = side.who;
        row.is_mean = job.frames > 0;
        row.on_the_wall = job.on_the_wall;
        for (const double value : values) row.answer += value;
        if (side.figures) row.figures = side.figures();
        compare(ours, values, job.tolerance, side.strays, row);
    }

    // Usually the thread's processor time and not wall-clock time, so that other processes don't count.
    const auto add = [&job](std::size_t number, const Side& side, double seconds) {
        benchmark::internal::Benchmark* registered = benchmark::RegisterBenchmark(
            std::to_string(number).c_str(),
            [&job, &side](benchmark::State& state) { time_calls(state, side, job.values); });
        if (job.frames > 0) {
            const Effort effort(seconds, job.frames);
            registered->Iterations(effort.frames);
            registered->Repetitions(effort.repetitions);
        } else {
            registered->Repetitions(static_cast<int>(std::clamp(seconds_of_calls / seconds, 3.0, 1.0 * repetitions)));
            registered->MinTime(seconds_each);
        }
    };
    for (std::size_t i = 0; i < job.sides.size(); ++i) add(i, job.sides[i], seconds_a_call[i]);
    // Pausing the clock between frames takes about 0.5 us. An empty side measures that overhead.
    const Side nothing{"", [](std::span<double>) {}, [] {}};
    if (job.frames > 0) add(job.sides.size(), nothing, 0);

    Collector collector(job.sides.size() + 1, job.on_the_wall);
    benchmark::RunSpecifiedBenchmarks(&collector);
    benchmark::ClearRegisteredBenchmarks();

    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::vector<double>& times = collector.times(i);
        const double seconds = job.frames > 0 ? mean(times) - median(collector.times(job.sides.size())) : median(times);
        rows[i].ns = 1e9 * seconds / static_cast<double>(job.items);
    }
    double best = std::numeric_limits<double>::infinity();
    for (const Row& row : rows)
        if (row.who.starts_with("abut") && row.who != chosen_side) best = std::min(best, row.ns);
    for (Row& row : rows) {
        row.ratio = rows[0].ns / row.ns;
        if (row.who == chosen_side) row.over_best = row.ns / best;
    }
    return rows;
}

}  // namespace abut::bench
