#pragma once

// The processor's threads, for bakes that take an Executor.

#include <abut/math/executor.hpp>

namespace abut::tool {

/// Starts its threads anew for each job: jobs are few and long here.
class Threads final : public Executor {
public:
    /// As many as the machine has.
    Threads();

    std::uint32_t workers() const override { return count_; }
    void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) override;

private:
    std::uint32_t count_;
};

}  // namespace abut::tool
