#pragma once

// The AABBs of a world's fixed items, or of its moving ones, with a broad phase over them.

#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/broad_phase/detail/reserve_one_more.hpp>
#include <abut/math/aabb.hpp>
#include <abut/world/detail/deferred_work.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abut::detail {

/// Gives each item a place, its index in the broad phase, and keeps the broad phase up to date.
///
/// A change costs a few nanoseconds. The first query after it updates the broad phase without allocating, on its own
/// thread: up to 8 changed boxes are tested one by one instead, more are set one by one, and if more than about an
/// eighth of all boxes changed, the whole structure is refitted.
template <int D>
class ItemBoxes {
public:
    /// With a fixed kind of broad phase; by default it is chosen by the boxes and their history.
    explicit ItemBoxes(std::optional<BroadPhaseKind> kind = {});

    /// Prepares for `count` calls of `add`. If these are many, the broad phase doesn't grow with each of them: the
    /// first query or refresh after them builds it anew.
    void expect(std::size_t count, double queries);
    /// Returns a new place for the item of this slot, with an empty box. `queries` is their number for each item, see
    /// BroadPhaseHistory.
    std::uint32_t add(std::uint32_t slot, double queries);
    /// Inline: a box that a call passes through memory is read before it is written.
    void set(std::uint32_t place, const Aabb<D>& box) {
        Aabb<D>& present = boxes_[place];
        if (box == present) return;
        present = box;
        ++changed_;
        if (is_stale_[place] == 0) mark_stale(place);
    }
    const Aabb<D>& box(std::uint32_t place) const { return boxes_[place]; }
    std::span<const Aabb<D>> boxes() const { return boxes_; }
    /// Gives the next refresh a larger box, so that queries may visit more items until the refresh after it, which
    /// takes the item's own box again.
    void widen(std::uint32_t place, const Aabb<D>& box);
    void remove(std::uint32_t place);
    /// The slot of the item that has this place, or of the last one that had it.
    std::uint32_t slot(std::uint32_t place) const { return slots_[place]; }
    std::span<const std::uint32_t> slots() const { return slots_; }
    /// The number of places, including free ones.
    std::size_t size() const { return boxes_.size(); }

    /// Whether any box differs from that in the broad phase since the last refresh.
    bool changed() const { return changed_ > 0 || refreshed_ != boxes_.size() || is_wide_ || !wide_.empty(); }
    /// Brings the broad phase up to date, by the threads of an executor if there is one.
    void refresh(double queries, Executor* executor = nullptr);
    /// The broad phase as of the last refresh.
    const ChosenBroadPhase<D>& phase() const { return phase_; }

    // Queries on the present boxes, like those of a BroadPhase, except that they visit the slots of items. They may run
    // on many threads at once.
    void each_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void raycast(const Ray<D>& ray, ReachCall visit) const;
    void sweep(const MovingBox<D>& box, ReachCall visit) const;
    void closest(const Aabb<D>& box, ReachCall visit, float max_distance) const;

private:
    /// The number of stale boxes up to which queries test them one by one.
    static constexpr std::size_t max_stale = 8;

    void mark_stale(std::uint32_t place) {
        is_stale_[place] = true;
        reserve_one_more(stale_);
        stale_.push_back(place);
        if (stale_.size() > max_stale) pending_work_.defer();
    }
    void mark_current();
    void prepare() const;
    template <class MakeReach, class Search>
    void each_within_reach(const MakeReach& make_reach, ReachCall visit, const Search& search) const;

    mutable ChosenBroadPhase<D> phase_;
    std::vector<Aabb<D>> boxes_;        // by place; empty if free
    std::vector<Aabb<D>> wide_;         // by place, for the next refresh; empty if no box is wider
    bool is_wide_ = false;              // whether the last refresh took wider boxes
    std::vector<std::uint32_t> slots_;  // by place
    std::vector<std::uint32_t> free_;
    std::size_t changed_ = 0;                  // changes since the last refresh, with repetition
    std::size_t refreshed_ = 0, planned_ = 0;  // numbers of places at the last refresh and choice of kind
    std::size_t expected_ = 0;                 // the broad phase doesn't grow up to this number of places
    // `prepare` alone changes these in const calls.
    mutable std::vector<std::uint32_t> stale_;  // places whose boxes differ from those in the broad phase
    mutable std::vector<char> is_stale_;        // by place
    mutable DeferredWork pending_work_;
};

extern template class ItemBoxes<2>;
extern template class ItemBoxes<3>;

}  // namespace abut::detail
