#pragma once

// A bar on stderr for work that takes long, if somebody is there to see it.

#include <abut/math/function_ref.hpp>

#include <chrono>
#include <cstddef>
#include <string>

namespace abut::tool {

/// Is told from time to time how much is done, and how much there is in all.
using ProgressCall = FunctionRef<void(std::size_t done, std::size_t all)>;

/// Shows itself after half a second, on a terminal only, and is gone without a trace when it goes out of scope.
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
