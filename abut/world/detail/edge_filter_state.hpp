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
#include <utility>
#include <vector>

namespace abut::detail {

/// The place of a box among a world's moving boxes (0) or its fixed ones (1).
class BoxIndex {
public:
    BoxIndex() = default;
    BoxIndex(std::uint32_t place, bool is_fixed) : bits_(place << 1 | (is_fixed ? 1u : 0u)) {}
    std::uint32_t place() const { return bits_ >> 1; }
    std::uint32_t kind() const { return bits_ & 1; }

private:
    std::uint32_t bits_;
};

template <int D>
struct Neighbour {
    const Aabb<D>* box;  ///< null: it overlaps nothing
    std::uint32_t slot;
};

/// The AABBs of four neighbours of an item, tested at once. Without branches, which could not predict how many there
/// are.
template <int D>
class NeighbourBlock {
public:
    static constexpr std::size_t lanes = 4;

    /// Of the first `count` neighbours, or all four; at(i) is one of them. Lanes without one have a box of NaNs, which
    /// overlaps nothing.
    template <class NeighbourAt>
    NeighbourBlock(std::size_t count, const NeighbourAt& at) {
        static constexpr float nan = std::numeric_limits<float>::quiet_NaN();
        static constexpr Aabb<D> no_box{Vec<D>(nan), Vec<D>(nan)};
        std::array<const Aabb<D>*, lanes> boxes;
        for (std::size_t i = 0; i < lanes; ++i) {
            const Neighbour<D> neighbour = at(std::min(i, count - 1));
            boxes[i] = i < count && neighbour.box != nullptr ? neighbour.box : &no_box;
            slots_[i] = static_cast<std::int32_t>(neighbour.slot);
        }
        // A box has D pairs of numbers, of which two fit in a register.
        for (std::size_t i = 0; i < static_cast<std::size_t>(D) - 1; ++i) {
            const auto load = [&](std::size_t lane) {
                return float4::load(reinterpret_cast<const float*>(boxes[lane]) + 2 * i);
            };
            std::array<float4::Floats, 4> row{load(0), load(1), load(2), load(3)};
            float4::transpose(row[0], row[1], row[2], row[3]);
            std::copy(row.begin(), row.end(), rows_.begin() + static_cast<std::ptrdiff_t>(2 * i));
        }
    }
    std::uint32_t slot(std::size_t lane) const { return static_cast<std::uint32_t>(slots_[lane]); }
    std::uint32_t overlap_bits(const Aabb<D>& box) const {
        float4::Mask overlap{-1, -1, -1, -1};
        for (std::size_t i = 0; i < static_cast<std::size_t>(D); ++i) {
            const int axis = static_cast<int>(i);
            overlap &= rows_[i] <= float4::broadcast(box.max[axis]);
            overlap &= rows_[static_cast<std::size_t>(D) + i] >= float4::broadcast(box.min[axis]);
        }
        return float4::bits(overlap);
    }
    /// The lanes with another slot.
    std::uint32_t other_bits(std::uint32_t slot) const {
        const auto s = static_cast<std::int32_t>(slot);
        return float4::bits(slots_ != float4::Mask{s, s, s, s});
    }

private:
    std::array<float4::Floats, 2 * D> rows_;  // the minimums along each axis, then the maximums
    float4::Mask slots_;
};

template <int D>
struct EdgeFilterState {
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    using Block = NeighbourBlock<D>;

    /// The neighbours of an item: its partners, with their boxes. The list is made when a contact needs it.
    struct List {
        std::uint32_t first_block = 0;    ///< in blocks
        std::uint32_t size = 0;           ///< number of neighbours
        std::uint32_t nearest = none;     ///< in nearest_to_center
        std::uint32_t last_cover = none;  ///< the neighbour that ended the last search, likely the next
        bool is_center_tested = false;    ///< for neighbours that contain it
        bool is_center_covered = false;
    };
    /// The partners of an item: the items that pair with it and are no sensors. They end where those of the next slot
    /// begin. Until add_partner() their number is stored there, and then their end so far.
    struct Partners {
        std::uint32_t begin = 0;    ///< in partners
        std::uint32_t list = none;  ///< in lists
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

    std::vector<Partners> partners_of_slot;  ///< and one more
    std::vector<BoxIndex> partners;
    std::vector<List> lists;
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
        partners_of_slot.assign(items + 1, {});
        lists.clear();
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
    void count_partner(std::uint32_t slot) { ++partners_of_slot[slot + 1].begin; }
    /// Reserves the places of the partners that were counted.
    void place_partners() {
        std::uint32_t count = 0;
        std::size_t with_list = 0;
        for (Partners& of_slot : partners_of_slot) {
            with_list += of_slot.begin < 2 ? 0 : 1;
            count += std::exchange(of_slot.begin, count);
        }
        partners.resize(count);
        // References to their elements stay valid during the update.
        lists.reserve(with_list);
        nearest_to_center.reserve(with_list);
    }
    void add_partner(std::uint32_t slot, BoxIndex partner) { partners[partners_of_slot[slot + 1].begin++] = partner; }
    std::span<const BoxIndex> partners_of(std::uint32_t slot) const {
        const std::uint32_t begin = partners_of_slot[slot].begin;
        return std::span(partners).subspan(begin, partners_of_slot[slot + 1].begin - begin);
    }
    bool has_list(std::uint32_t slot) const { return partners_of_slot[slot].list != none; }
    /// The neighbours of an item, listed on the first call, when neighbour_of(partner) returns them. Null for an item
    /// with less than two partners, and for one that is never filtered.
    template <class NeighbourOf>
    List* list_of(std::uint32_t slot, const NeighbourOf& neighbour_of) {
        Partners& of_slot = partners_of_slot[slot];
        if (of_slot.list != none) return &lists[of_slot.list];
        const std::span found = partners_of(slot);
        if (found.size() < 2) return nullptr;
        of_slot.list = static_cast<std::uint32_t>(lists.size());
        List& list = lists.emplace_back();
        list.first_block = static_cast<std::uint32_t>(blocks.size());
        list.size = static_cast<std::uint32_t>(found.size());
        for (std::size_t i = 0; i < found.size(); i += Block::lanes)
            blocks.emplace_back(found.size() - i, [&](std::size_t lane) { return neighbour_of(found[i + lane]); });
        return &list;
    }
    /// The same after the first call.
    List& list_of(std::uint32_t slot) { return lists[partners_of_slot[slot].list]; }

    /// Valid until the next update.
    NearestToCenter<D>& nearest_of(List& list) {
        if (list.nearest == none) {
            list.nearest = static_cast<std::uint32_t>(nearest_to_center.size());
            nearest_to_center.emplace_back();
        }
        return nearest_to_center[list.nearest];
    }
    /// Whether the AABB of a neighbour other than this one overlaps a box.
    bool has_neighbour(const List& list, const Aabb<D>& near, std::uint32_t except) const {
        std::uint32_t found = 0;
        const Block* block = blocks.data() + list.first_block;
        for (std::uint32_t i = 0; i < list.size; i += Block::lanes, ++block)
            found |= block->overlap_bits(near) & block->other_bits(except);
        return found != 0;
    }
    /// Calls visit(neighbour) for the neighbours whose AABBs overlap a box, until it returns false. Returns whether all
    /// were visited.
    template <class Visit>
    bool each_neighbour(const List& list, const Aabb<D>& near, const Visit& visit) const {
        const Block* block = blocks.data() + list.first_block;
        for (std::uint32_t i = 0; i < list.size; i += Block::lanes, ++block)
            for (std::uint32_t left = block->overlap_bits(near); left != 0; left &= left - 1)
                if (!visit(block->slot(static_cast<std::size_t>(std::countr_zero(left))))) return false;
        return true;
    }

    /// Reserves memory for the worst case of a scene of this size: all its pairs change, and all contacts are ghosts.
    void reserve(std::size_t items, std::size_t near_pairs, std::size_t contacts) {
        partners_of_slot.reserve(items + 1);
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
