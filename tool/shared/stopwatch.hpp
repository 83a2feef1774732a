#pragma once

// Measures wall-clock time for the reports.

#include <chrono>

namespace abut::tool {

class Stopwatch {
public:
    /// Seconds since the last lap.
    double lap() {
        const auto now = Clock::now();
        const std::chrono::duration<double> passed = now - last_;
        last_ = now;
        return passed.count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

}  // namespace abut::tool
