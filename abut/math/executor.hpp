#pragma once

// The interface to a game's job system, for calls that run on several threads.

#include <abut/math/function_ref.hpp>

#include <cstdint>

namespace abut {

/// Runs the parts of a job in parallel. Implement both functions, or use ThreadPool; abut starts no threads but
/// those of a ThreadPool.
class Executor {
public:
    virtual ~Executor() = default;

    /// The number of parts that may run at the same time, at least 1. A job is divided into about this number of parts
    /// or a few times as many; results don't depend on it.
    virtual std::uint32_t workers() const = 0;

    /// Calls part(0) to part(count - 1), each once, in any order and on any threads; returns when all have returned.
    virtual void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) = 0;
};

}  // namespace abut
