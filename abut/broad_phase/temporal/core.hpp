#pragma once

// The part of Temporal<D> that does not depend on the inner broad phase. Not for users.

#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

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
    static constexpr double endless = std::numeric_limits<double>::infinity();

    /// Each count times about what it takes in nanoseconds; no clock is read.
    static double cost_of(const TemporalCounts& counts) {
        return 30 * static_cast<double>(counts.searches) + 20 * static_cast<double>(counts.looks) +
               0.2 * static_cast<double>(counts.plain_looks);
    }

    double length_ = endless, factor_ = 1.5;
    double cost_ = 0, last_rate_ = endless, rest_rate_ = endless;
    std::uint64_t updates_ = 0;
    bool resting_ = false;
};

/// 64 pairs, each with the time at which it is due to be tested again. A block in which none is due is skipped.
struct PairBlock {
    static constexpr std::uint32_t capacity = 64;
    static constexpr float never = std::numeric_limits<float>::infinity();

    std::array<ItemPair, capacity> pairs;
    std::array<float, capacity> due;  ///< `never` beyond the last pair
    float next_due = never;           ///< the earliest
    std::uint32_t count = 0;
    std::uint64_t touching = 0;  ///< a bit a pair

    PairBlock() { due.fill(never); }
    void set(std::size_t i, float due_at, bool touches) {
        due[i] = due_at;
        next_due = std::min(next_due, due_at);
        touching = (touching & ~(std::uint64_t{1} << i)) | std::uint64_t{touches} << i;
    }
};

inline constexpr float temporal_leeway = 4e-6f;

/// An item is slow or fast. A search for the neighbours of slow items is valid for some time; then its pairs are tested
/// as they become due. Fast items are searched for in each update.
template <int D>
class TemporalCore {
public:
    /// Each is followed by a search for slow items if `slow_due`, by `test_due`, and by a search for fast items.
    void build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds);
    void update(std::span<const Aabb<D>> boxes, double time);
    void set_top_speed(std::uint32_t item, float speed);
    /// Makes an item fast until the slow ones are searched next.
    void leave(std::uint32_t item);
    float top_speed(std::uint32_t item) const { return wanted_[item]; }

    bool slow_due() const { return slow_due_; }
    /// Boxes that contain those of the slow items until the next search; empty boxes for fast items.
    std::span<const Aabb<D>> grown_boxes() const { return search_boxes_; }
    void add_slow(std::uint32_t i, std::uint32_t j) { add({i, j}, 0, false); }
    void test_due(std::span<const Aabb<D>> boxes);
    /// The boxes of the fast items. The searches refer to them by their index in this span.
    std::span<const Aabb<D>> fast_boxes(std::span<const Aabb<D>> boxes);
    void add_fast(std::uint32_t i, std::uint32_t j) {
        ++counts_.looks;
        add({fast_[i], fast_[j]}, PairBlock::never, true);
    }
    void add_mixed(std::span<const Aabb<D>> boxes, std::uint32_t slow, std::uint32_t fast);

    void visit_pairs(PairsCall visit, Executor* executor) const;
    std::size_t size() const { return items_.size(); }
    const TemporalCounts& counts() const { return counts_; }

private:
    struct Item {
        Aabb<D> box;      ///< at the last search for slow items
        float speed;      ///< that no face has exceeded since; infinite for a fast item
        float tolerance;  ///< for the rounding of its faces until the next search
        /// How far a face may be from where it was.
        float margin(double time) const {
            const double travel = speed > 0 ? static_cast<double>(speed) * time : 0;
            return static_cast<float>(travel * (1 + temporal_leeway)) + tolerance;
        }
        bool is_fast() const { return speed == std::numeric_limits<float>::infinity(); }
    };
    bool is_too_fast(const Item& item, const Aabb<D>& box);
    void grow_slow(std::span<const Aabb<D>> boxes);
    void remove_left();
    void add(const ItemPair& pair, float due, bool touches) {
        if (blocks_.size() == slow_blocks_ || blocks_.back().count == PairBlock::capacity) blocks_.emplace_back();
        PairBlock& block = blocks_.back();
        block.pairs[block.count] = std::minmax(pair.first, pair.second);
        block.set(block.count++, due, touches);
    }

    std::vector<Item> items_;
    std::vector<float> wanted_;        // the top speeds as they were given last
    std::vector<std::uint32_t> fast_;  // items that were fast at the last search for slow ones, or have left since
    std::vector<Aabb<D>> search_boxes_;
    std::vector<PairBlock> blocks_;  // pairs of slow items, and then pairs with a fast item, which overlap
    std::size_t slow_blocks_ = 0;
    SearchWindow window_;
    TemporalCounts counts_;
    float now_ = 0;   // the time since the last search for slow items, not rounded down
    double end_ = 0;  // when the next is due
    double spacing_ = 0;
    std::size_t left_count_ = 0,
                waited_ = 0;  // items that have left the slow ones, and updates that each has been fast
    bool slow_due_ = false, has_left_ = false;
};

extern template class TemporalCore<2>;
extern template class TemporalCore<3>;

}  // namespace detail
}  // namespace abut
