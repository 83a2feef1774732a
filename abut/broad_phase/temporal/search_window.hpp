#pragma once

// Chooses by counts how long the result of a search is valid. For .cpp files.

#include <algorithm>
#include <cstdint>
#include <limits>

namespace abut::detail {

/// The time T for which boxes are grown. A long T needs few searches and finds many pairs; a short one the opposite. T
/// is multiplied by the factor that lowered the cost of an update last time, else by its reciprocal (hill climbing). If
/// a search would be valid for an update or two, the window rests: each update searches in boxes that are not grown,
/// and the window tries again from time to time. A cost is a count times about what each takes in nanoseconds; no clock
/// is read.
class SearchWindow {
public:
    static constexpr double item_cost = 30, pair_cost = 15, look_cost = 20, held_cost = 0.2;

    /// Starts with an estimate of T.
    void begin(double length) {
        *this = {};
        length_ = length;
    }
    void spend(double cost) { cost_ += cost; }
    void count_update() { ++updates_; }

    double length() const { return length_; }
    bool rests() const { return resting_; }
    bool has_rested() const { return resting_ && updates_ >= rest_for_; }

    /// Call at the end of the window, or of its rest. `step` is about the time of an update.
    void close(double step) {
        const double rate = cost_ / updates_;
        cost_ = updates_ = 0;
        if (resting_) {
            rest_rate_ = rate;
            last_rate_ = std::numeric_limits<double>::infinity();
            length_ = std::max(length_, 4 * step);
            resting_ = false;
        } else if (rate > rest_rate_) {
            rest_for_ = std::min(2 * rest_for_, longest_rest);
            resting_ = true;
        } else {
            rest_for_ = first_rest;
            // Reverses with a factor nearer to 1, but not too near.
            if (rate > last_rate_) factor_ = factor_ > 1 ? 1 / (1 + 0.7 * (factor_ - 1)) : 1 + 0.7 * (1 / factor_ - 1);
            factor_ = factor_ > 1 ? std::max(factor_, 1.1) : std::min(factor_, 1 / 1.1);
            last_rate_ = rate;
            length_ *= factor_;
            resting_ = length_ < 2 * step;
        }
    }

private:
    static constexpr std::uint32_t first_rest = 32, longest_rest = 1024;

    double length_ = 0, factor_ = 1.5;
    double cost_ = 0, last_rate_ = std::numeric_limits<double>::infinity(),
           rest_rate_ = std::numeric_limits<double>::infinity();
    std::uint32_t updates_ = 0, rest_for_ = first_rest;
    bool resting_ = false;
};

}  // namespace abut::detail
