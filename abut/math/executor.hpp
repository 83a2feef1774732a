#pragma once

// Several threads: what a game's job system has to offer, for those calls that take it.

#include <abut/math/function_ref.hpp>

#include <cstdint>

namespace abut {

/// Runs the parts of a job side by side. Fill the two functions by what you have; abut starts no threads of its own.
class Executor {
public:
    virtual ~Executor() = default;

    /// How many parts may run at the same time, at least 1. A job is cut into about so many parts or a few times as
    /// many; no answer depends on it.
    virtual std::uint32_t workers() const = 0;

    /// Calls part(0) to part(count - 1), each once, in any order and on any threads; returns when all have returned.
    virtual void run(std::uint32_t count, FunctionRef<void(std::uint32_t)> part) = 0;
};

}  // namespace abut
