#pragma once

// Judges the pairs of the corpus on all threads of the machine.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace abut::corpus {

/// The sum of `judge(number, summary)` over the numbers first to last - 1. The counts don't depend on the number of
/// threads; only the choice of reported failures does.
template <class Sum, class Judge>
Sum by_all_threads(std::uint64_t first, std::uint64_t last, const Judge& judge) {
    constexpr std::uint64_t piece = 500;
    std::atomic<std::uint64_t> next = first;
    std::mutex mutex;
    Sum all;
    const auto work = [&] {
        Sum own;
        for (std::uint64_t from = next.fetch_add(piece); from < last; from = next.fetch_add(piece))
            for (std::uint64_t number = from; number < std::min(from + piece, last); ++number) judge(number, own);
        const std::lock_guard lock(mutex);
        all.add(own);
    };
    std::vector<std::thread> threads;
    for (unsigned i = std::max(1u, std::thread::hardware_concurrency()); i > 0; --i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    return all;
}

}  // namespace abut::corpus
