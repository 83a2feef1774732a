#pragma once

// Pairs that are found on several threads. For .cpp files.

#include <abut/broad_phase/visit.hpp>
#include <abut/math/executor.hpp>

#include <atomic>
#include <cstdint>
#include <span>

namespace abut {

/// Runs part(i, told) for i from 0 to count - 1. Each part tells its pairs to `told`, which hands them on to the
/// visitor; once that has had enough, so have all parts, and those that haven't begun don't.
template <class Part>
void tell_together(Executor& executor, std::uint32_t count, PairsCall visit, Part part) {
    std::atomic<bool> enough = false;
    const auto told = [&](std::span<const ItemPair> pairs) {
        if (enough.load(std::memory_order_relaxed)) return false;
        if (visit(pairs)) return true;
        enough.store(true, std::memory_order_relaxed);
        return false;
    };
    executor.run(count, [&](std::uint32_t i) {
        if (!enough.load(std::memory_order_relaxed)) part(i, PairsCall(told));
    });
}

}  // namespace abut
