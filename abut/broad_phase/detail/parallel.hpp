#pragma once

// Work on several threads. For .cpp files.

#include <abut/broad_phase/visit.hpp>
#include <abut/math/executor.hpp>

#include <atomic>
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

}  // namespace abut::detail
