#pragma once

// Work on several threads. For .cpp files.

#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/executor.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut::detail {

/// Calls task(0) to task(count - 1): by the executor if there is one, else in this order.
template <class Task>
void run_parallel(Executor* executor, std::uint32_t count, Task&& task) {
    if (executor != nullptr && count > 1) return executor->run(count, task);
    for (std::uint32_t i = 0; i < count; ++i) task(i);
}

/// Runs task(i, report) for i from 0 to count - 1. Each task passes its pairs to `report`, which forwards them to the
/// visitor. Once the visitor returns false, `report` returns false in all tasks, and no further task starts.
template <class Task>
void report_in_parallel(Executor& executor, std::uint32_t count, PairsCall visit, Task task) {
    std::atomic<bool> stopped = false;
    const auto report = [&](std::span<const ItemPair> pairs) {
        if (stopped.load(std::memory_order_relaxed)) return false;
        if (visit(pairs)) return true;
        stopped.store(true, std::memory_order_relaxed);
        return false;
    };
    executor.run(count, [&](std::uint32_t i) {
        if (!stopped.load(std::memory_order_relaxed)) task(i, PairsCall(report));
    });
}

/// Reports the pairs of `count` items, in ranges of at least `min_count` items if there is an executor: as many as are
/// worth a thread. add_pairs(begin, end, pairs) returns false as soon as the buffer does.
template <class AddPairs>
void report_ranges(Executor* executor, std::size_t count, std::size_t min_count, PairsCall visit,
                   const AddPairs& add_pairs) {
    const std::size_t parts =
        executor == nullptr ? 1 : std::clamp<std::size_t>(count / min_count, 1, 4 * std::size_t{executor->workers()});
    const auto report_range = [&](std::size_t part, PairsCall report) {
        PairBuffer pairs(report);
        if (add_pairs(count * part / parts, count * (part + 1) / parts, pairs)) pairs.flush();
    };
    if (parts == 1) return report_range(0, visit);
    report_in_parallel(*executor, static_cast<std::uint32_t>(parts), visit, report_range);
}

/// Reports the pairs of an item of one structure with an item of another: queries the second with each box of the
/// first. If `reversed`, the item of the second comes first in a pair.
template <class Phase, class Other>
void report_between(const Phase& phase, const Other& other, PairsCall visit, bool reversed = false) {
    PairBuffer pairs(visit);
    bool go_on = true;
    phase.each_box([&](std::uint32_t i, const auto& box) {
        other.each_overlapping(box,
                               [&](std::uint32_t j) { return go_on = reversed ? pairs.add(j, i) : pairs.add(i, j); });
        return go_on;
    });
    if (go_on) pairs.flush();
}

}  // namespace abut::detail
