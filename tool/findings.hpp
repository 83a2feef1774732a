#pragma once

// What is found of the pairs, frame by frame.

#include "meeting.hpp"
#include "near_pairs.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <vector>

namespace abut::tool {

/// One pair, over one unbroken interval of frames, at its deepest moment; or between two frames at neither of which it
/// is found.
template <int D>
struct Finding {
    std::size_t a = 0, b = 0;                                 ///< objects; a < b, in the order of their paths
    std::size_t first = 0, last = 0, deepest = 0;             ///< frames
    float distance = std::numeric_limits<float>::infinity();  ///< signed
    float allow = 0;                                          ///< what was allowed of this pair then
    Vec<D> normal{};                                          ///< from a to b
    std::vector<Vec<D>> points;
    bool inside = false;   ///< a body is inside of the other, whose surface it meets nowhere, or no deeper than allowed
    bool between = false;  ///< after the frame `first` and before the next, at the times that follow
    double time = 0, last_time = 0, deepest_time = 0;  ///< seconds: as they first meet, last seen so, and deepest
};

/// Joins what is found at one frame after the other. Of more findings than `max_findings` it gives only the deepest,
/// and keeps no more than twice as many with all that there is to say of them.
template <int D>
class Findings {
public:
    explicit Findings(std::size_t max_findings) : max_findings_(max_findings) {}

    // Of a frame, pair by pair in their order, then its end:
    void add(const Pair& pair, std::size_t frame, Meeting<D>&& meeting);
    /// Stands as it stood at the frame before.
    void go_on(const Pair& pair, std::size_t frame);
    void end_frame();

    /// Of the way to the next frame.
    void add(Finding<D>&& between);

    /// Whether the pair was found at the frame that ended last.
    bool has(const Pair& pair) const;

    /// All of them, by pair and time. To be called once, at the end.
    std::vector<Finding<D>> take();
    /// How many there were beyond those.
    std::uint64_t left_out() const { return left_out_; }

private:
    /// One that may go on.
    struct Open {
        Pair pair;
        std::uint32_t first = 0, last = 0;
        float distance = std::numeric_limits<float>::infinity();
        std::unique_ptr<Finding<D>> details;  ///< none where so many are deeper that it is left out as it stands
    };

    /// The deepest comes first.
    using Rank = std::tuple<float, Pair, std::size_t>;

    static Rank rank(const Open& open) { return {open.distance, open.pair, open.first}; }
    static Rank rank(const Finding<D>& finding) {
        return {finding.distance,
                {static_cast<std::uint32_t>(finding.a), static_cast<std::uint32_t>(finding.b)},
                finding.first};
    }
    void close_before(const Pair& pair);
    void close(Open&& open);
    void prune();

    std::size_t max_findings_;
    std::vector<Open> open_, next_;  ///< of the last frame that ended, and of the one that goes on; sorted by pair
    std::size_t next_open_ = 0;      ///< of those of the last frame, the first that isn't yet looked at
    std::vector<Finding<D>> closed_;
    std::size_t count_details_ = 0;
    Rank last_ = {std::numeric_limits<float>::infinity(), {}, 0};  ///< what comes later can't be among the deepest
    std::uint64_t left_out_ = 0;
};

}  // namespace abut::tool
