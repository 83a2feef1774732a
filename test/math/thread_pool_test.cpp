// The threads of a ThreadPool: each part runs once, whoever calls, and a call returns when all its parts have.

#include "../oracle/sanitized.hpp"
#include <abut/math/thread_pool.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#ifdef __linux__
#include <sys/mman.h>
#include <sys/resource.h>
#endif

namespace abut::test {
namespace {

TEST(ThreadPool, RunsEachPartOnce) {
    for (const std::uint32_t workers : {1u, 2u, 3u, 8u}) {
        ThreadPool pool(workers);
        EXPECT_EQ(pool.workers(), workers);
        for (std::uint32_t count = 0; count < 200; ++count) {
            std::vector<int> runs(count, 0);
            pool.run(count, [&](std::uint32_t i) { ++runs[i]; });
            EXPECT_EQ(std::count(runs.begin(), runs.end(), 1), static_cast<std::ptrdiff_t>(count));
        }
    }
    EXPECT_GE(ThreadPool().workers(), 1u);
}

// Room for all of them was reserved before: 32 GB.
TEST(ThreadPool, HasAMaximumOfWorkers) {
    ThreadPool pool(std::numeric_limits<std::uint32_t>::max());
    EXPECT_LE(pool.workers(), ThreadPool::max_workers);
    std::atomic<int> runs = 0;
    pool.run(10, [&](std::uint32_t) { ++runs; });
    EXPECT_EQ(runs, 10);
}

TEST(ThreadPool, RunsPartsAtTheSameTime) {
    ThreadPool pool(2);
    std::atomic<int> arrived = 0;
    // Each of the two parts waits for the other one.
    pool.run(2, [&](std::uint32_t) {
        ++arrived;
        while (arrived < 2) std::this_thread::yield();
    });
    EXPECT_EQ(arrived, 2);
}

// The caller has run its own part long before.
TEST(ThreadPool, WaitsForThePartsOfOtherThreads) {
    ThreadPool pool(2);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> arrived = 0, ended = 0;
    pool.run(2, [&](std::uint32_t) {
        ++arrived;
        while (arrived < 2) std::this_thread::yield();
        if (std::this_thread::get_id() != caller) std::this_thread::sleep_for(std::chrono::milliseconds(30));
        ++ended;
    });
    EXPECT_EQ(ended, 2);
}

// A thread that wakes up when its job has ended, and the next one has begun, takes no part of either away.
TEST(ThreadPool, JobsMayBeShorterThanAWakeUp) {
    ThreadPool pool(4);
    for (int job = 0; job < 50'000; ++job) {
        std::array<std::atomic<int>, 5> runs{};
        pool.run(5, [&](std::uint32_t i) { ++runs[i]; });
        for (const std::atomic<int>& each : runs) ASSERT_EQ(each, 1) << job;
    }
}

TEST(ThreadPool, APartMayRunAJob) {
    ThreadPool pool(3), other(2);
    std::atomic<std::uint32_t> sum = 0;
    pool.run(10, [&](std::uint32_t i) {
        pool.run(10, [&](std::uint32_t j) { sum += 10 * i + j; });
        other.run(2, [&](std::uint32_t) { ++sum; });
    });
    EXPECT_EQ(sum, 99u * 100 / 2 + 20);
}

TEST(ThreadPool, ManyThreadsMayRunJobs) {
    ThreadPool pool(2);
    std::vector<std::uint64_t> sums(4);
    std::vector<std::thread> callers;
    for (std::uint64_t& sum : sums)
        callers.emplace_back([&] {
            for (int job = 0; job < 200; ++job) {
                std::vector<std::uint32_t> parts(7);
                pool.run(7, [&](std::uint32_t i) { parts[i] = i; });
                sum += std::accumulate(parts.begin(), parts.end(), 0u);
            }
        });
    for (std::thread& caller : callers) caller.join();
    EXPECT_EQ(sums, std::vector<std::uint64_t>(4, 200u * 21));
}

/// Regression: a pool of 500 threads in 300 MB of address space ended the program, by std::terminate.
#ifdef __linux__
TEST(ThreadPool, TakesFewerThreadsIfTheSystemRefusesMore) {
    if (oracle::sanitized) GTEST_SKIP() << "not in builds with sanitizers";
    const auto run_with_little_memory = [] {
        const rlimit limit{300'000'000, 300'000'000};
        if (setrlimit(RLIMIT_AS, &limit) != 0) std::exit(1);
        ThreadPool pool(500);
        std::atomic<std::uint32_t> runs = 0;
        pool.run(1000, [&](std::uint32_t) { ++runs; });
        // An emulator may let a process have more than its limit.
        void* const beyond = mmap(nullptr, 2 * limit.rlim_cur, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        std::_Exit(runs == 1000 && (pool.workers() < 500 || beyond != MAP_FAILED) ? 0 : 2);
    };
    EXPECT_EXIT(run_with_little_memory(), testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace abut::test
