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
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    /// The neighbours of an item: the items that pair with it and whose AABBs overlap its AABB.
    struct List {
        std::uint32_t first = 0, size = 0;  ///< in neighbours and neighbour_boxes
        std::uint32_t nearest = none;       ///< in nearest_to_center
        bool is_center_tested = false;      ///< for neighbours that contain it
        bool is_center_covered = false;
    };

    /// By slot: the number of its pairs in World::near_, and from add_list() on the index of its list with this bit.
    static constexpr std::uint32_t has_list = 0x80000000;
    std::vector<std::uint32_t> list_of_slot;
    std::vector<List> lists;
    std::vector<std::uint32_t> neighbours;  ///< slots
    BoxSoa<D> neighbour_boxes;              ///< their AABBs
    std::vector<NearestToCenter<D>> nearest_to_center;
    std::vector<char> has_ghost;                   ///< by slot
    CompressedLists<std::uint32_t> found_by_slot;  ///< indices in World::found_, in an update with substitute normals
    ViewCache<D> views;
    std::vector<char> neighbour_changed;  ///< by slot: an item near it has changed since the last update
    bool neighbour_changed_is_known = false;

    void begin_update(std::size_t items) {
        list_of_slot.assign(items, 0);
        lists.clear();
        neighbours.clear();
        nearest_to_center.clear();
        views.clear();
        neighbour_changed_is_known = false;
    }
    void add_list(std::uint32_t slot) {
        const std::uint32_t count = list_of_slot[slot];
        if (count < 2 || count >= has_list) return;
        list_of_slot[slot] = static_cast<std::uint32_t>(lists.size()) | has_list;
        lists.push_back({.first = static_cast<std::uint32_t>(neighbours.size())});
        neighbours.resize(neighbours.size() + count);
    }
    void begin_neighbours() {
        neighbour_boxes.reserve(neighbours.size());
        nearest_to_center.reserve(lists.size());
    }
    void add_neighbour(std::uint32_t slot, std::uint32_t neighbour, const Aabb<D>& box) {
        List* const list = list_of(slot);
        if (list == nullptr) return;
        neighbours[list->first + list->size] = neighbour;
        neighbour_boxes.set(list->first + list->size++, box);
    }

    /// Null for an item without a second neighbour.
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
    /// Calls visit(neighbour) for the neighbours of an item whose AABBs overlap a box, until it returns false. Returns
    /// whether all were visited.
    template <class Visit>
    bool each_neighbour(std::uint32_t slot, const Aabb<D>& near, const Visit& visit) const {
        constexpr std::size_t bits_at_once = 64;
        const List& list = lists[list_of_slot[slot] & ~has_list];
        for (std::size_t i = list.first; i < list.first + list.size; i += bits_at_once) {
            const std::size_t count = std::min(list.first + list.size - i, bits_at_once);
            std::uint64_t left = overlap_bits(neighbour_boxes.view(), i, count, near);
            for (; left != 0; left &= left - 1)
                if (!visit(neighbours[i + static_cast<std::size_t>(std::countr_zero(left))])) return false;
        }
        return true;
    }

    /// Reserves memory for the worst case of a scene of this size: all its pairs change, and all contacts are ghosts.
    void reserve(std::size_t items, std::size_t near_pairs, std::size_t contacts) {
        list_of_slot.reserve(items);
        lists.reserve(std::min(items, near_pairs));
        nearest_to_center.reserve(std::min(items, near_pairs));
        neighbours.reserve(2 * near_pairs);
        neighbour_boxes.reserve(2 * near_pairs);
        has_ghost.reserve(items);
        found_by_slot.reserve(items, 2 * contacts);
        neighbour_changed.reserve(items);
    }
};

}  // namespace abut::detail
