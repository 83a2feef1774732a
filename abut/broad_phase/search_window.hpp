#pragma once

// For how long a search for neighbours shall hold: how far boxes are grown for it, found by counting. For .cpp files.

#include <cstdint>
#include <limits>

namespace abut {

/// A wide margin is searched for seldom and holds many pairs, a narrow one the other way round. The margin climbs to
/// where both together cost least an update, by the factor that helped last time. Where things are so fast that a
/// search would hold for an update or two, the window rests: each update searches then, in boxes that aren't grown.
/// From time to time it tries again. Costs are counts, times about what each takes in nanoseconds; no clock has a say.
class SearchWindow {
public:
    static constexpr double item_cost = 30, pair_cost = 15, look_cost = 20, held_cost = 0.2;

    /// From nothing, with a first guess.
    void begin(double margin);

    /// Adds to what the window costs.
    void spend(double cost) { cost_ += cost; }
    void count_update() { ++updates_; }

    /// How long a search holds for what goes at most `speed`.
    double length(double speed) const { return speed > 0 ? margin_ / speed : std::numeric_limits<double>::infinity(); }
    /// The window has gone by. An update takes about `step`.
    void close(double speed, double step);

    bool rests() const { return resting_; }
    /// While it rests: whether it is time to try again.
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

}  // namespace abut
