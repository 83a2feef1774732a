#pragma once

// The boxes of a world's items: those that are fixed, or those that move.

#include <abut/broad_phase/chosen_broad_phase.hpp>
#include <abut/math/aabb.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace abut {

/// Gives each item a place, so that the broad phase over them has none but these, and keeps it up to date.
template <int D>
class ItemBoxes {
public:
    /// With a broad phase of this kind; by default, of whichever suits.
    explicit ItemBoxes(std::optional<BroadPhaseKind> always = {});

    /// A place for the item of this slot, with an empty box.
    std::uint32_t add(std::uint32_t slot);
    void set(std::uint32_t place, const Aabb<D>& box);
    /// A wider box for an item that has moved, of which `set` was told: it isn't counted again.
    void widen(std::uint32_t place, const Aabb<D>& box);
    void remove(std::uint32_t place);
    /// The slot of the item that has the place, or had it last.
    std::uint32_t slot(std::uint32_t place) const { return slots_[place]; }
    /// So many places there are, some of them free.
    std::size_t size() const { return boxes_.size(); }

    /// Some box is another than that in the broad phase.
    bool changed() const { return changed_ > 0 || phase_.size() != boxes_.size(); }
    /// Takes the boxes as they are now into the broad phase. `asked`: see BroadPhaseHistory.
    void refresh(double asked);
    const ChosenBroadPhase<D>& phase() const { return phase_; }

private:
    ChosenBroadPhase<D> phase_;
    std::vector<Aabb<D>> boxes_;        // by place; of a free one, empty
    std::vector<std::uint32_t> slots_;  // by place
    std::vector<std::uint32_t> free_;
    std::size_t changed_ = 0;  // since the last refresh, one that changed twice counted twice
};

extern template class ItemBoxes<2>;
extern template class ItemBoxes<3>;

}  // namespace abut
