#pragma once

// A bar on stderr for work that takes long, if somebody is there to see it.

#include <chrono>
#include <cstddef>
#include <string>

namespace abut::tool {

/// Shows itself after half a second, on a terminal only, and is gone without a trace when it goes out of scope.
class Progress {
public:
    explicit Progress(std::string what);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::size_t done, std::size_t all);

private:
    using Clock = std::chrono::steady_clock;

    std::string what_;
    bool is_terminal_;
    bool is_shown_ = false;
    Clock::time_point next_;
};

}  // namespace abut::tool
