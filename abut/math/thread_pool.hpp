#pragma once

// An Executor with threads of its own, for programs without a job system.

#include <abut/math/executor.hpp>

#include <cstdint>
#include <memory>

namespace abut {

/// Runs the parts of a job on its threads and on the one that calls `run`. Calls of `run` from several threads take
/// turns; within a part, `run` calls its parts in order, on the same thread. No part may throw. A thread without work
/// waits about 0.1 ms for the next job before it sleeps.
class ThreadPool final : public Executor {
public:
    static constexpr std::uint32_t max_workers = 1024;

    /// With this many workers, the calling thread included and at most `max_workers`; by default as many as the machine
    /// runs at the same time. If the system refuses a thread, with those before it. Where the standard library has no
    /// threads, with one worker.
    explicit ThreadPool(std::uint32_t workers = 0);
    ~ThreadPool() override;

    std::uint32_t workers() const override;
    void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) override;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace abut
