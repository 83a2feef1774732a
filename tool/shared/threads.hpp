#pragma once

// A thread pool for bakes that take an Executor.

#include <abut/math/executor.hpp>

namespace abut::tool {

/// Starts its threads for each job, as jobs are few and long.
class Threads final : public Executor {
public:
    /// Uses all hardware threads.
    Threads();

    std::uint32_t workers() const override { return count_; }
    void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) override;

private:
    std::uint32_t count_;
};

}  // namespace abut::tool
