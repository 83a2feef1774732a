#pragma once

// The part of Temporal<D> that does not depend on the inner broad phase. Not for users.

#include <abut/broad_phase/temporal/search_window.hpp>
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

namespace abut::detail {

template <int D>
struct BoxLanes;

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
        touching = (touching & ~(std::uint64_t{1} << i)) | std::uint64_t{touches} << i;
    }
};

/// An item is slow or fast. A search for the neighbours of slow items is valid for some time; then its pairs are tested
/// as they become due. Fast items are searched for in each update.
template <int D>
class TemporalCore {
public:
    /// Each is followed by a search for slow items if `slow_due`, by `test_due`, and by a search for fast items.
    void build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds);
    void update(std::span<const Aabb<D>> boxes, double time);
    void set_top_speed(std::uint32_t item, float speed);
    void jumped(std::uint32_t item) { leave(item); }
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
        Aabb<D> box;  ///< at the last search for slow items
        float speed;  ///< that no face has exceeded since; infinite for a fast item
        bool is_fast() const { return speed == std::numeric_limits<float>::infinity(); }
    };
    void leave(std::uint32_t item);
    bool is_too_fast(const Item& item, const BoxLanes<D>& box);
    void grow_slow(std::span<const Aabb<D>> boxes);
    void remove_left();
    void add(const ItemPair& pair, float due, bool touches) {
        if (blocks_.size() == slow_blocks_ || blocks_.back().count == PairBlock::capacity) blocks_.emplace_back();
        PairBlock& block = blocks_.back();
        block.pairs[block.count] = std::minmax(pair.first, pair.second);
        block.set(block.count++, due, touches);
        block.next_due = std::min(block.next_due, due);
    }

    std::vector<Item> items_;
    std::vector<float> wanted_;        // the top speeds as they were given last
    std::vector<std::uint32_t> fast_;  // items that were fast at the last search for slow ones, or have left since
    std::vector<Aabb<D>> search_boxes_;
    std::vector<PairBlock> blocks_;  // pairs of slow items, and then pairs with a fast item, which overlap
    std::size_t slow_blocks_ = 0;
    SearchWindow window_;
    TemporalCounts counts_;
    double now_ = 0, end_ = 0;  // the time since the last search for slow items, and when the next is due
    float elapsed_ = 0;         // `now_`, not rounded down
    double spacing_ = 0;
    std::size_t left_count_ = 0,
                waited_ = 0;  // items that have left the slow ones, and updates that each has been fast
    bool slow_due_ = false, has_left_ = false;
};

extern template class TemporalCore<2>;
extern template class TemporalCore<3>;

}  // namespace abut::detail
