#pragma once

// What a world needs during an update, beside its results. For .cpp files.

#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/world/detail/deferred_work.hpp>
#include <abut/world/detail/neighbourhoods.hpp>
#include <abut/world/detail/pair_results.hpp>
#include <abut/world/detail/slot_cache.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace abut::detail {

/// The items of a larger world leave the second cache of common processors, and are fetched ahead of their use. In a
/// smaller one this would take a twentieth of an update.
constexpr std::size_t max_cached_items = 4096;

/// A contact of items without parts that isn't filtered yet, by its index among those found, and for which of its items
/// it needs that, with their neighbours near it.
template <int D>
struct UnfilteredContact {
    std::uint32_t found;
    bool for_a, for_b;
    NearNeighbours<D> near_a, near_b;
    DeepestParts<D> deepest;

    /// Written out, as that of DeepestParts: clearing all of it first is slow.
    UnfilteredContact() {}
};

/// What one thread remembers between tests of pairs.
template <int D>
struct PairTestMemory {
    /// Contacts are filtered together, so that the code of either step stays in the instruction cache.
    static constexpr std::size_t max_unfiltered = 32;

    SlotCache<View<D>, 1024> views;        ///< fits in the second cache of common processors
    SlotCache<DVec<D>, 1024> own_offsets;  ///< of these views as they were made, if positions are doubles
    View<D> first;                         ///< of the first item of a pair whose views have the same place
    std::array<UnfilteredContact<D>, max_unfiltered> unfiltered;
    std::size_t unfiltered_count = 0;
    /// The points nearest to the centres of items, for contacts of which an item is A or B.
    std::array<SlotCache<NearestToCenter<D>, 256>, 2> nearest;

    void clear(bool with_offsets) {
        views.clear();
        if (with_offsets) own_offsets.clear();
        for (auto& of_side : nearest) of_side.clear();
    }
    /// Where the next contact goes.
    UnfilteredContact<D>& next_unfiltered() { return *std::construct_at(&unfiltered[unfiltered_count]); }
    /// Adds it, by its index among those found. Returns whether it is time to filter the contacts.
    bool add_unfiltered(std::size_t found) {
        unfiltered[unfiltered_count].found = static_cast<std::uint32_t>(found);
        return ++unfiltered_count == max_unfiltered;
    }
};

template <int D>
struct UpdateState {
    Neighbourhoods<D> neighbours;
    std::vector<PairTestMemory<D>> memories;  ///< one for each part that may run at the same time
    std::vector<std::uint32_t> free_memories;
    std::vector<PairResults<D>> parts;
    std::vector<TouchingSlots> unsorted;  ///< memory for the touching pairs while these are sorted
    /// The contacts of each item, in an update with substitute normals: contact i of those found has the places 2 i
    /// (for its A) and 2 i + 1 (for its B) in found_before, which refer to the item's place before.
    std::vector<std::uint32_t> last_found;  ///< by slot
    std::vector<std::uint32_t> found_before;
    std::vector<char> neighbour_changed;  ///< by slot: an item near it has changed since the last update
    DeferredWork find_neighbour_changed;

    /// Reserves memory for the worst case of a scene of this size: all its pairs change, and all contacts are ghosts.
    void reserve(std::size_t items, std::size_t near_pairs, std::size_t contacts) {
        neighbours.reserve(items, near_pairs);
        last_found.reserve(items);
        found_before.reserve(2 * contacts);
        neighbour_changed.reserve(items);
    }
};

}  // namespace abut::detail
