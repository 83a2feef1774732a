#pragma once

// The memory of a world's filter of internal edges during an update. For .cpp files.

#include <abut/math/simd/float4-inl.h>
#include <abut/query/detail/surface/surface_contacts.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace abut::detail {

/// The AABBs of four neighbours of an item, tested at once. Those without a neighbour are NaNs, which overlap nothing.
template <int D>
struct NeighbourBlock {
    static constexpr std::uint32_t lanes = 4;
    using Numbers = std::array<float, lanes>;

    std::array<Numbers, D> min, max;
    std::array<std::uint32_t, lanes> slots;

    NeighbourBlock() {
        constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        min.fill({nan, nan, nan, nan});
        max = min;
    }
    void set(std::uint32_t lane, std::uint32_t slot, const Aabb<D>& box) {
        slots[lane] = slot;
        for (int axis = 0; axis < D; ++axis) {
            min[static_cast<std::size_t>(axis)][lane] = box.min[axis];
            max[static_cast<std::size_t>(axis)][lane] = box.max[axis];
        }
    }
    std::uint32_t overlap_bits(const Aabb<D>& box) const {
        float4::Mask overlap{-1, -1, -1, -1};
        for (int axis = 0; axis < D; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            overlap &= float4::load(min[i].data()) <= float4::broadcast(box.max[axis]);
            overlap &= float4::load(max[i].data()) >= float4::broadcast(box.min[axis]);
        }
        return float4::bits(overlap);
    }
};

template <int D>
struct EdgeFilterState {
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    using Block = NeighbourBlock<D>;

    /// The neighbours of an item: the items that pair with it, are no sensors, and whose AABBs overlap its AABB. They
    /// are found among its partners, the items that pair with it, when a contact needs them.
    struct List {
        std::uint32_t first_partner = 0, partner_count = 0;  ///< in partners
        std::uint32_t first_block = none;                    ///< in blocks; none: the neighbours aren't found yet
        std::uint32_t size = 0;                              ///< number of neighbours
        std::uint32_t nearest = none;                        ///< in nearest_to_center
        std::uint32_t last_cover = none;  ///< the neighbour that ended the last search, likely the next
        bool is_center_tested = false;    ///< for neighbours that contain it
        bool is_center_covered = false;
    };

    /// A contact of items without parts that isn't filtered yet, by its index in World::found_, and for which of its
    /// items it needs that.
    struct Unfiltered {
        std::uint32_t found;
        bool for_a, for_b;
        DeepestParts<D> deepest;
    };
    /// They are filtered together, so that the code of either step stays in the instruction cache.
    static constexpr std::size_t max_unfiltered = 32;

    /// By slot: the number of its partners, and from add_partner() on the index of its list with this bit.
    static constexpr std::uint32_t has_list = 0x80000000;
    std::vector<std::uint32_t> list_of_slot;
    std::vector<List> lists;
    std::vector<std::uint32_t> partners;  ///< slots
    std::vector<Block> blocks;
    std::vector<NearestToCenter<D>> nearest_to_center;
    std::array<Unfiltered, max_unfiltered> unfiltered;
    std::size_t unfiltered_count = 0;
    /// The contacts of each item, in an update with substitute normals: contact i of World::found_ has the places 2 i
    /// (for its A) and 2 i + 1 (for its B) in found_before, which refer to the item's place before.
    std::vector<std::uint32_t> last_found;  ///< by slot
    std::vector<std::uint32_t> found_before;
    std::vector<char> neighbour_changed;  ///< by slot: an item near it has changed since the last update
    bool neighbour_changed_is_known = false;

    void begin_update(std::size_t items) {
        list_of_slot.assign(items, 0);
        lists.clear();
        partners.clear();
        blocks.clear();
        nearest_to_center.clear();
        unfiltered_count = 0;
        neighbour_changed_is_known = false;
    }
    /// Where the parts of the next contact go.
    DeepestParts<D>& next_deepest() { return *std::construct_at(&unfiltered[unfiltered_count].deepest); }
    /// Adds it, by its index in World::found_. Returns whether it is time to filter the contacts.
    bool add_unfiltered(std::size_t found) {
        unfiltered[unfiltered_count].found = static_cast<std::uint32_t>(found);
        return ++unfiltered_count == max_unfiltered;
    }
    /// An item with a single partner has no second neighbour, and so no list.
    void add_partner(std::uint32_t slot, std::uint32_t partner) {
        std::uint32_t& place = list_of_slot[slot];
        if (place < 2) return;
        if (place < has_list) {
            lists.push_back({.first_partner = static_cast<std::uint32_t>(partners.size())});
            partners.resize(partners.size() + place);
            place = static_cast<std::uint32_t>(lists.size() - 1) | has_list;
        }
        List& list = lists[place & ~has_list];
        partners[list.first_partner + list.partner_count++] = partner;
    }
    /// Finds the neighbours of an item on the first call; box_of(partner) is null for a partner that is none. Returns
    /// their number.
    template <class BoxOf>
    std::uint32_t find_neighbours(List& list, const BoxOf& box_of) {
        if (list.first_block != none) return list.size;
        list.first_block = static_cast<std::uint32_t>(blocks.size());
        for (const std::uint32_t partner : std::span(partners).subspan(list.first_partner, list.partner_count)) {
            const Aabb<D>* const box = box_of(partner);
            if (box == nullptr) continue;
            const std::uint32_t lane = list.size++ % Block::lanes;
            if (lane == 0) blocks.emplace_back();
            blocks.back().set(lane, partner, *box);
        }
        return list.size;
    }

    /// Null for an item with less than two partners, and for one that is never filtered.
    List* list_of(std::uint32_t slot) {
        return list_of_slot[slot] < has_list ? nullptr : &lists[list_of_slot[slot] & ~has_list];
    }
    /// Valid until the next update.
    NearestToCenter<D>& nearest_of(List& list) {
        if (list.nearest == none) {
            list.nearest = static_cast<std::uint32_t>(nearest_to_center.size());
            nearest_to_center.emplace_back();
        }
        return nearest_to_center[list.nearest];
    }
    /// Calls visit(neighbour) for the neighbours whose AABBs overlap a box, until it returns false. Returns whether all
    /// were visited.
    template <class Visit>
    bool each_neighbour(const List& list, const Aabb<D>& near, const Visit& visit) const {
        const Block* block = blocks.data() + list.first_block;
        for (std::uint32_t i = 0; i < list.size; i += Block::lanes, ++block)
            for (std::uint32_t left = block->overlap_bits(near); left != 0; left &= left - 1)
                if (!visit(block->slots[static_cast<std::size_t>(std::countr_zero(left))])) return false;
        return true;
    }

    /// Reserves memory for the worst case of a scene of this size: all its pairs change, and all contacts are ghosts.
    void reserve(std::size_t items, std::size_t near_pairs, std::size_t contacts) {
        list_of_slot.reserve(items);
        lists.reserve(std::min(items, near_pairs));
        nearest_to_center.reserve(std::min(items, near_pairs));
        partners.reserve(2 * near_pairs);
        blocks.reserve(near_pairs);
        last_found.reserve(items);
        found_before.reserve(2 * contacts);
        neighbour_changed.reserve(items);
    }
};

}  // namespace abut::detail
