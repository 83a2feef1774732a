#pragma once

// Chooses by counts how far boxes are grown for a search for neighbours, and so how long its result is valid. For .cpp
// files.

#include <cstdint>
#include <limits>

namespace abut::detail {

/// A wide margin needs few searches and finds many pairs; a narrow one needs many searches and finds few pairs. The
/// margin is multiplied by the factor that helped last time, towards the least cost an update. If items are so fast
/// that a search would be valid for an update or two, the window rests: each update searches in boxes that are not
/// grown, and the window tries again from time to time. A cost is a count times about what each takes in nanoseconds;
/// no clock is read.
class SearchWindow {
public:
    static constexpr double item_cost = 30, pair_cost = 15, look_cost = 20, held_cost = 0.2;

    /// Starts with an estimate of the margin.
    void begin(double margin);

    /// Adds to the cost of the window.
    void spend(double cost) { cost_ += cost; }
    void count_update() { ++updates_; }

    /// How long a search is valid for items of at most this speed.
    double length(double speed) const { return speed > 0 ? margin_ / speed : std::numeric_limits<double>::infinity(); }
    /// Call at the end of the window. `step` is about the time of an update.
    void close(double speed, double step);

    bool rests() const { return resting_; }
    /// True if a resting window tries again now.
    bool wakes(double speed, double step);

private:
    static constexpr std::uint32_t first_rest = 32, longest_rest = 1024;

    double rate() const { return cost_ / updates_; }
    void count_anew() { cost_ = updates_ = 0; }

    double margin_ = 0, factor_ = 1.5;
    double cost_ = 0, last_rate_ = std::numeric_limits<double>::infinity(),
           rest_rate_ = std::numeric_limits<double>::infinity();
    std::uint32_t updates_ = 0, rest_for_ = first_rest;
    bool resting_ = false;
};

}  // namespace abut::detail
