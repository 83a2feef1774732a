#pragma once

// The boxes of a world's items: those that are fixed, or those that move.

#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/math/aabb.hpp>
#include <abut/world/put_off.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace abut {

/// Gives each item a place, so that the broad phase over them has none but these, and keeps it up to date.
///
/// A change costs a few nanoseconds. The first query after it brings the broad phase up to date, in whichever thread it
/// runs, without allocating: a few boxes are tested one by one, more are set one by one, and where an eighth of all has
/// changed the whole is refitted.
template <int D>
class ItemBoxes {
public:
    /// With a broad phase of this kind; by default, of whichever suits.
    explicit ItemBoxes(std::optional<BroadPhaseKind> always = {});

    /// A place for the item of this slot, with an empty box.
    std::uint32_t add(std::uint32_t slot);
    void set(std::uint32_t place, const Aabb<D>& box);
    const Aabb<D>& box(std::uint32_t place) const { return boxes_[place]; }
    /// The next refresh takes this wider box; what queries visit may be a little more then. The one after it takes the
    /// item's own again.
    void widen(std::uint32_t place, const Aabb<D>& box);
    void remove(std::uint32_t place);
    /// The slot of the item that has the place, or had it last.
    std::uint32_t slot(std::uint32_t place) const { return slots_[place]; }
    /// So many places there are, some of them free.
    std::size_t size() const { return boxes_.size(); }

    /// Some box is another than that in the broad phase.
    bool changed() const { return changed_ > 0 || refreshed_ != boxes_.size() || is_wide_ || !wide_.empty(); }
    /// Takes the boxes as they are now into the broad phase. `asked`: see BroadPhaseHistory.
    void refresh(double asked);
    /// As of the last refresh.
    const ChosenBroadPhase<D>& phase() const { return phase_; }

    // Queries, as those of a BroadPhase, but that visit(slot) is given the slots of items. Of boxes as they are now; on
    // as many threads at once as wish to.
    void each_overlapping(const Aabb<D>& box, ItemCall visit) const;
    void raycast(const Ray<D>& ray, ReachCall visit) const;
    void sweep(const MovingBox<D>& box, ReachCall visit) const;
    void closest(const Aabb<D>& box, ReachCall visit, float reach) const;

private:
    void mark(std::uint32_t place);
    void settle();
    void prepare() const;
    template <class Reach, class Search>
    void each_within(Reach reach, ReachCall visit, const Search& search) const;

    mutable ChosenBroadPhase<D> phase_;
    std::vector<Aabb<D>> boxes_;        // by place; of a free one, empty
    std::vector<Aabb<D>> wide_;         // the same for the next refresh, where some are wider
    bool is_wide_ = false;              // the last refresh took some that were
    std::vector<std::uint32_t> slots_;  // by place
    std::vector<std::uint32_t> free_;
    std::size_t changed_ = 0;                  // since the last refresh, one that changed twice counted twice
    std::size_t refreshed_ = 0, planned_ = 0;  // places at the last refresh, and when the kind was last chosen
    // What a query changes, it changes in `prepare`.
    mutable std::vector<std::uint32_t> stale_;  // places whose boxes are not those in the broad phase
    mutable std::vector<char> is_stale_;        // by place
    mutable PutOff work_;
};

extern template class ItemBoxes<2>;
extern template class ItemBoxes<3>;

}  // namespace abut
