#pragma once

// The memory of a world's filter of internal edges during an update. For .cpp files.

#include <abut/broad_phase/detail/box_overlaps.hpp>
#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/world/detail/compressed_lists.hpp>
#include <abut/world/detail/view_cache.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

template <int D>
struct EdgeFilterState {
    /// What is known of the surface around the centre of an item.
    struct Center {
        NearestToCenter<D> nearest;
        bool is_tested = false;   ///< for neighbours that contain it
        bool is_covered = false;  ///< by a neighbour
    };
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::vector<std::uint32_t> list_of_slot;  ///< index in centers and neighbours; none for an item whose contacts stay
    std::vector<Center> centers;
    /// The items that pair with an item and whose AABBs overlap its AABB, and these AABBs in the same order.
    CompressedLists<std::uint32_t> neighbours;
    BoxSoa<D> neighbour_boxes;
    std::vector<char> has_ghost;                   ///< by slot
    CompressedLists<std::uint32_t> found_by_slot;  ///< indices in World::found_, in an update with substitute normals
    ViewCache<D> views;
    std::vector<char> neighbour_changed;  ///< by slot: an item near it has changed since the last update
    bool neighbour_changed_is_known = false;

    std::size_t neighbour_count(std::uint32_t slot) const { return neighbours.of(list_of_slot[slot]).size(); }
    /// Calls visit(neighbour) for the neighbours of an item whose AABBs overlap a box, until it returns false. Returns
    /// whether all were visited.
    template <class Visit>
    bool each_neighbour(std::uint32_t slot, const Aabb<D>& near, const Visit& visit) const {
        constexpr std::size_t bits_at_once = 64;
        const std::uint32_t list = list_of_slot[slot];
        const std::span<const std::uint32_t> slots = neighbours.of(list);
        for (std::size_t i = 0; i < slots.size(); i += bits_at_once) {
            const std::size_t count = std::min(slots.size() - i, bits_at_once);
            std::uint64_t left = overlap_bits(neighbour_boxes.view(), neighbours.first(list) + i, count, near);
            for (; left != 0; left &= left - 1)
                if (!visit(slots[i + static_cast<std::size_t>(std::countr_zero(left))])) return false;
        }
        return true;
    }
    Center& center_of(std::uint32_t slot) { return centers[list_of_slot[slot]]; }

    void add_list(std::uint32_t slot) {
        list_of_slot[slot] = static_cast<std::uint32_t>(centers.size());
        centers.emplace_back();
    }

    /// Reserves memory for the worst case of a scene of this size: all its pairs change, and all contacts are ghosts.
    void reserve(std::size_t items, std::size_t near_pairs, std::size_t contacts) {
        list_of_slot.reserve(items);
        centers.reserve(std::min(items, 2 * near_pairs));
        neighbours.reserve(std::min(items, 2 * near_pairs), 2 * near_pairs);
        neighbour_boxes.reserve(2 * near_pairs);
        has_ghost.reserve(items);
        found_by_slot.reserve(items, 2 * contacts);
        neighbour_changed.reserve(items);
    }
};

}  // namespace abut::detail
