#pragma once

// Collects contacts of pairs over frames.

#include "tool/check/overlapping_pairs.hpp"
#include "tool/check/pair_contact.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <vector>

namespace abut::tool {

/// A contact of one pair over one unbroken interval of frames, at its deepest time; or between two consecutive frames
/// at neither of which the pair is in contact.
template <int D>
struct ContactFinding {
    std::size_t a = 0, b = 0;                                 ///< objects sorted by path; a < b
    std::size_t first = 0, last = 0, deepest = 0;             ///< frames
    float distance = std::numeric_limits<float>::infinity();  ///< signed
    float allow = 0;                                          ///< depth allowed for this pair
    Vec<D> normal{};                                          ///< from a to b
    std::vector<Vec<D>> points;
    bool inside = false;   ///< one body is inside the other without touching its surface deeper than allowed
    bool between = false;  ///< between the frame `first` and the next one, at the times below
    double time = 0, last_time = 0, deepest_time = 0;  ///< seconds: first contact, last contact, deepest contact
};

/// Joins contacts of consecutive frames to intervals. Returns at most `max_findings`, the deepest ones, and stores
/// details of at most twice as many.
template <int D>
class ContactFindings {
public:
    explicit ContactFindings(std::size_t max_findings) : max_findings_(max_findings) {}

    /// Sets the depth of a contact of the last frame, found at a frame of it, if it is deeper there.
    void deepen(const Pair& pair, std::size_t frame, PairContact<D>&& contact);

    // Per frame: add or extend pairs in sorted order, then end the frame.
    void add(const Pair& pair, std::size_t frame, PairContact<D>&& contact);
    /// The same without a depth: `deepen` follows before the first frame without a contact of the pair.
    void add(const Pair& pair, std::size_t frame);
    /// Extends the contact of the last frame, if there is one: neither object moved.
    void extend(const Pair& pair, std::size_t frame);
    void end_frame();

    /// Adds a contact between this frame and the next one.
    void add(ContactFinding<D>&& between);

    /// True if the pair was in contact at the last frame.
    bool has(const Pair& pair) const;

    /// Returns all findings, sorted by pair and time. Call once, at the end.
    std::vector<ContactFinding<D>> take();
    /// Count of findings beyond the maximum.
    std::uint64_t left_out() const { return left_out_; }

private:
    /// A contact that may continue at the next frame.
    struct Open {
        Pair pair;
        std::uint32_t first = 0, last = 0;
        float distance = std::numeric_limits<float>::infinity();
        std::unique_ptr<ContactFinding<D>> details;  ///< null if at least `max_findings` are deeper at present
    };

    /// Orders by depth, deepest first.
    using Rank = std::tuple<float, Pair, std::size_t>;

    static Rank rank(const Open& open) { return {open.distance, open.pair, open.first}; }
    static Rank rank(const ContactFinding<D>& finding) {
        return {finding.distance,
                {static_cast<std::uint32_t>(finding.a), static_cast<std::uint32_t>(finding.b)},
                finding.first};
    }
    typename std::vector<Open>::const_iterator find(const Pair& pair) const;
    void deepen(Open& open, std::size_t frame, PairContact<D>&& contact);
    void close_until(const Pair& pair);
    void close(Open&& open);
    void prune();

    std::size_t max_findings_;
    std::vector<Open> open_, next_;  ///< contacts of the last frame and of the current frame; sorted by pair
    std::size_t next_open_ = 0;      ///< first contact of the last frame that isn't processed yet
    std::vector<ContactFinding<D>> closed_;
    std::size_t count_details_ = 0;
    Rank last_ = {
        std::numeric_limits<float>::infinity(), {}, 0};  ///< findings that rank later are not among the deepest
    std::uint64_t left_out_ = 0;
};

}  // namespace abut::tool
