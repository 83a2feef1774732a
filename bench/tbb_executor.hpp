#pragma once

// abut's Executor with oneTBB, as a game that uses it would write it.

#include <abut/math/executor.hpp>

#include <cstdint>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace abut::bench {

class TbbExecutor final : public Executor {
public:
    explicit TbbExecutor(std::uint32_t threads) : arena_(static_cast<int>(threads)), threads_(threads) {}

    std::uint32_t workers() const override { return threads_; }

    void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) override {
        arena_.execute([&] { tbb::parallel_for(std::uint32_t{0}, count, part, tbb::simple_partitioner()); });
    }

private:
    tbb::task_arena arena_;
    std::uint32_t threads_;
};

}  // namespace abut::bench
