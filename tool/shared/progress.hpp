#pragma once

// A progress bar on stderr, shown on a terminal only.

#include <abut/math/function_ref.hpp>

#include <chrono>
#include <cstddef>
#include <string>

namespace abut::tool {

/// Called from time to time with the completed and the total amount of work.
using ProgressCall = FunctionRef<void(std::size_t done, std::size_t all)>;

/// Appears after half a second if stderr is a terminal, and is erased by the destructor.
class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void operator()(std::size_t done, std::size_t all);

private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    bool is_terminal_;
    bool is_shown_ = false;
    Clock::time_point next_;
};

}  // namespace abut::tool
