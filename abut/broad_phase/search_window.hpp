#pragma once

// For how long a search for neighbours shall hold: the margin by which boxes are grown, found by counting. For .cpp
// files.

#include <cstdint>
#include <limits>

namespace abut {

/// A wide margin is searched for seldom and holds many pairs, a narrow one the other way round. The margin climbs to
/// where both together cost least an update, by the factor that helped last time. Where things are so fast that a
/// search holds for an update or two, it rests at none: then each update searches, and holds those pairs alone that
/// touch. Costs are counts times about a nanosecond each; no clock has a say.
class SearchWindow {
public:
    static constexpr double item_cost = 50, pair_cost = 15, look_cost = 10, held_cost = 0.1;

    /// From nothing, with a first guess.
    void begin(double margin);

    /// Adds to what the window costs.
    void spend(double cost) { cost_ += cost; }
    void count_update() { ++updates_; }

    /// How long the next search shall hold; 0 is until the next update. `over` where the last one held to its end, and
    /// was not cut short. An item goes at most `speed`, an update takes about `step`.
    double next(double speed, double step, bool over);

    /// Whether each update searches.
    bool rests() const { return resting_; }

private:
    static constexpr std::uint32_t first_rest = 32, longest_rest = 1024;

    double rest();

    double margin_ = 0, factor_ = 1.5;
    double cost_ = 0;
    double last_rate_ = std::numeric_limits<double>::infinity();  // costs an update
    double rest_rate_ = std::numeric_limits<double>::infinity();
    std::uint32_t updates_ = 0, rest_for_ = first_rest;
    bool resting_ = false;
};

}  // namespace abut
