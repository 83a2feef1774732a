#pragma once

// Counts the work of a Temporal, and chooses by it how long the result of a search is valid.

#include <algorithm>
#include <cstdint>
#include <limits>

namespace abut {

/// The work of a Temporal, and that of a broad phase that tests everything in each update.
struct TemporalCounts {
    std::uint64_t updates = 0;
    std::uint64_t searches = 0;        ///< searches for the neighbours of an item
    std::uint64_t looks = 0;           ///< tests of a pair: found by a search, or due
    std::uint64_t plain_searches = 0;  ///< one an item and update
    std::uint64_t plain_looks = 0;     ///< one a pair and update, of the pairs that are held
    std::uint64_t too_fast = 0;        ///< items found farther away than their top speed allows
};

namespace detail {

/// The time T for which boxes are grown. A long T needs few searches and finds many pairs; a short one the opposite. T
/// is multiplied by the factor that lowered the cost of an update last time, else by its reciprocal (hill climbing). If
/// a search would be valid for an update or two, the window rests: each update searches in boxes that are not grown,
/// and the window tries again from time to time.
class SearchWindow {
public:
    /// Starts with an estimate of T.
    void begin(double length) { length_ = length; }

    double length() const { return length_; }
    bool rests() const { return resting_; }
    bool has_rested(std::uint64_t updates) const { return updates - updates_ >= rest_for; }

    /// Call at the end of the window, or of its rest. `step` is about the time of an update.
    void close(const TemporalCounts& counts, double step) {
        const double cost = cost_of(counts), rate = (cost - cost_) / static_cast<double>(counts.updates - updates_);
        cost_ = cost;
        updates_ = counts.updates;
        if (resting_) {
            rest_rate_ = rate;
            length_ = std::max(length_, 4 * step);
            resting_ = false;
        } else {
            if (rate > last_rate_) factor_ = 1 / factor_;
            length_ *= factor_;
            resting_ = rate > rest_rate_ || length_ < 2 * step;
        }
        last_rate_ = rate;
    }

private:
    static constexpr std::uint64_t rest_for = 256;

    /// Each count times about what it takes in nanoseconds; no clock is read.
    static double cost_of(const TemporalCounts& counts) {
        return 30 * static_cast<double>(counts.searches) + 20 * static_cast<double>(counts.looks) +
               0.2 * static_cast<double>(counts.plain_looks);
    }

    double length_ = std::numeric_limits<double>::infinity(), factor_ = 1.5;
    double cost_ = 0, last_rate_ = std::numeric_limits<double>::infinity(),
           rest_rate_ = std::numeric_limits<double>::infinity();
    std::uint64_t updates_ = 0;
    bool resting_ = false;
};

}  // namespace detail
}  // namespace abut
