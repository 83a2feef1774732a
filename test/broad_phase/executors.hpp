#pragma once

// Executors with several threads.

#include <abut/math/executor.hpp>

#include <atomic>
#include <thread>
#include <vector>

namespace abut::test {

/// Starts new threads for each job; the threads compete for its parts.
class ThreadExecutor : public Executor {
public:
    explicit ThreadExecutor(std::uint32_t workers) : workers_(workers) {}

    std::uint32_t workers() const override { return workers_; }
    void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) override {
        std::atomic<std::uint32_t> next = 0;
        const auto work = [&] {
            for (std::uint32_t i = next++; i < count; i = next++) part(i);
        };
        std::vector<std::thread> threads;
        for (std::uint32_t i = 1; i < workers_; ++i) threads.emplace_back(work);
        work();
        for (std::thread& thread : threads) thread.join();
    }

private:
    std::uint32_t workers_;
};

}  // namespace abut::test
