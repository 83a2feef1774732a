#pragma once

// The part of Temporal<D> that does not depend on the inner broad phase. Not for users.

#include <abut/broad_phase/temporal/search_window.hpp>
#include <abut/broad_phase/temporal/timed_pairs.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
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

template <int D>
struct BoxLanes;

/// An item is slow or fast. Each box is given in every call; a search refers to items by their place among the slow or
/// among the fast.
template <int D>
class TemporalCore {
public:
    /// Each is followed by the searches: of the slow items if `slow_due`, of the fast ones always.
    void build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds);
    void update(std::span<const Aabb<D>> boxes, double time);
    void set_top_speed(std::uint32_t item, float speed);
    void jumped(std::uint32_t item);
    float top_speed(std::uint32_t item) const { return wanted_[item]; }

    bool slow_due() const { return slow_due_; }
    /// Boxes that contain those of the slow items until the next search.
    std::span<const Aabb<D>> grown_boxes() const { return found_in_; }
    void add_slow(std::uint32_t i, std::uint32_t j);
    std::span<const Aabb<D>> fast_boxes(std::span<const Aabb<D>> boxes);
    void add_fast(std::uint32_t i, std::uint32_t j);
    void add_mixed(std::span<const Aabb<D>> boxes, std::uint32_t slow, std::uint32_t fast);
    void end_search();

    void visit_pairs(PairsCall visit, Executor* executor) const;
    std::size_t size() const { return items_.size(); }
    const TemporalCounts& counts() const { return counts_; }

private:
    struct Item {
        Aabb<D> box;  ///< at the last search for slow items
        float speed;  ///< that no face has exceeded since
        bool is_fast;
    };
    void start(std::span<const Aabb<D>> boxes);
    void advance(double time);
    void leave(std::uint32_t item);
    void remove_left();
    bool is_too_fast(const Item& item, const BoxLanes<D>& box);
    void test_due(std::span<const Aabb<D>> boxes);
    void grow_slow(std::span<const Aabb<D>> boxes);

    std::vector<Item> items_;
    std::vector<float> wanted_;               // the top speeds as they were given last
    std::vector<std::uint32_t> slow_, fast_;  // the former as of the last search: some may have left
    std::vector<Aabb<D>> found_in_;           // the boxes for a search
    TimedPairs slow_pairs_;
    std::vector<ItemPair> fast_pairs_;  // those that overlap now
    std::size_t found_ = 0;             // pairs found by the searches of an update
    SearchWindow window_;
    TemporalCounts counts_;
    double now_ = 0, step_ = 0;   // the time, and the last step
    double start_ = 0, end_ = 0;  // of the time for which the last search is valid
    float elapsed_ = 0;           // since the start
    double spacing_ = 0;
    double left_count_ = 0, waited_ = 0;  // items that have left the slow ones, and updates that each has been fast
    bool slow_due_ = false, has_left_ = false;
};

extern template class TemporalCore<2>;
extern template class TemporalCore<3>;

}  // namespace detail
}  // namespace abut
