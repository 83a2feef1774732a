#pragma once

// The neighbours of a world's items, which together form the surfaces that an item touches. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/simd/lanes-inl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace abut::detail {

/// The items near another one, with their boxes.
template <int D>
class NeighbourList {
public:
    /// Up to three boxes and slots behind the last ones are read, too.
    NeighbourList(const Aabb<D>* boxes, const std::uint32_t* slots, std::size_t size)
        : boxes_(boxes), slots_(slots), size_(size) {}

    std::size_t size() const { return size_; }
    std::uint32_t slot(std::size_t i) const { return slots_[i]; }

    /// Tests up to 64 neighbours from `first` on: bit k is set if the box of neighbour `first + k` overlaps this one,
    /// unless it is the item `but`.
    std::uint64_t overlap_bits(std::size_t first, const Aabb<D>& box, std::uint32_t but) const {
        const std::size_t count = std::min(size() - first, std::size_t{64});
        std::uint64_t result = 0;
        for (std::size_t i = 0; i < count; i += 4)
            result |= std::uint64_t{overlap_bits_of_four(first + i, box, but)} << i;
        return result;
    }
    bool any_overlaps(const Aabb<D>& box, std::uint32_t but) const {
        for (std::size_t i = 0; i < size(); i += 4)
            if (overlap_bits_of_four(i, box, but) != 0) return true;
        return false;
    }
    /// Calls visit(slot) for the neighbours whose boxes overlap this one, except one item, until it returns false.
    template <class Visit>
    void each_overlapping(const Aabb<D>& box, std::uint32_t but, const Visit& visit) const {
        for (std::size_t first = 0; first < size(); first += 64)
            for (std::uint64_t left = overlap_bits(first, box, but); left != 0; left &= left - 1)
                if (!visit(slot(first + static_cast<std::size_t>(std::countr_zero(left))))) return;
    }

private:
    /// Of four neighbours, of which the last ones may be none.
    std::uint32_t overlap_bits_of_four(std::size_t begin, const Aabb<D>& other, std::uint32_t but) const {
        static_assert(sizeof(Aabb<D>) == 2 * D * sizeof(float));
        const float* const boxes = &boxes_[begin].min[0];
        constexpr std::size_t n = 2 * D;
        std::array<lanes::Floats4, n> bounds;
        for (std::size_t i = 0; i < n; i += 2) {
            const lanes::Floats4 first = lanes::pairs_at(boxes + i, boxes + n + i);
            const lanes::Floats4 last = lanes::pairs_at(boxes + 2 * n + i, boxes + 3 * n + i);
            bounds[i] = lanes::shuffled<0, 2, 0, 2>(first, last);
            bounds[i + 1] = lanes::shuffled<1, 3, 1, 3>(first, last);
        }
        lanes::Mask4 overlap = (bounds[0] <= other.max[0]) & (bounds[D] >= other.min[0]);
        for (std::size_t axis = 1; axis < D; ++axis)
            overlap = overlap & (bounds[axis] <= other.max[static_cast<int>(axis)]) &
                      (bounds[axis + D] >= other.min[static_cast<int>(axis)]);
        const lanes::Mask4 is_but = lanes::at(slots_ + begin) == lanes::Ints4(static_cast<std::int32_t>(but));
        const std::uint32_t listed = begin + 4 <= size_ ? 0xF : (1u << size_ % 4) - 1;
        return lanes::bits(overlap) & ~lanes::bits(is_but) & listed;
    }

    const Aabb<D>* boxes_;
    const std::uint32_t* slots_;
    std::size_t size_;
};

/// The neighbours of an item in a region near a contact, except the other item of the contact.
template <int D>
struct NearNeighbours {
    static constexpr std::size_t max_listed = 64;

    Aabb<D> region;
    std::uint64_t bits;  ///< one for each neighbour of the list

    /// Written out: clearing them first is slow.
    NearNeighbours() {}

    /// Finds them, except one item. Returns whether there are any, or the list is too long: then they stay unknown.
    bool find(const NeighbourList<D>& list, const Aabb<D>& in, std::uint32_t but) {
        bits = list.overlap_bits(0, in, but);
        const bool is_long = list.size() > max_listed;
        region = is_long ? Aabb<D>::empty() : in;
        return is_long | (bits != 0);
    }
    /// Whether those in this box are among them.
    bool cover(const Aabb<D>& box) const { return contains(region, box); }
    /// Calls visit(slot) for all, until it returns false.
    template <class Visit>
    void each(const NeighbourList<D>& list, const Visit& visit) const {
        for (std::uint64_t left = bits; left != 0; left &= left - 1)
            if (!visit(list.slot(static_cast<std::size_t>(std::countr_zero(left))))) return;
    }
};

/// Two items, each part of the surface that the other one touches.
struct NeighbourPair {
    struct Side {
        std::uint32_t slot;
        std::uint32_t place;     ///< of its box among the fixed or the moving ones
        std::uint32_t is_fixed;  ///< 0 or 1; a fixed item has no list
    };
    std::array<Side, 2> sides;
};

/// The neighbours of all items that aren't fixed, in an update that filters internal edges.
template <int D>
class Neighbourhoods {
public:
    void begin_update(std::size_t items) {
        static_assert(std::is_trivially_copyable_v<OfSlot>);
        of_slot_.resize(items);
        if (items > 0) std::memset(static_cast<void*>(of_slot_.data()), 0, items * sizeof(OfSlot));
        pairs_.clear();
    }
    void add(std::span<const NeighbourPair> pairs) {
        pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
        for (const NeighbourPair& pair : pairs)
            for (const NeighbourPair::Side& side : pair.sides) of_slot_[side.slot].end += 1 - side.is_fixed;
    }
    /// Makes the lists, when all pairs are added, with the boxes of the moving and of the fixed items. Lists that begin
    /// after one another lie beside each other.
    void make_lists(const std::array<std::span<const Aabb<D>>, 2>& boxes) {
        slots_.resize(std::max(slots_.size(), lists_size(pairs_.size())));
        boxes_.resize(slots_.size());
        std::uint32_t lists_end = 1;
        for (const NeighbourPair& pair : pairs_)
            for (std::size_t i = 0; i < 2; ++i) {
                const NeighbourPair::Side &side = pair.sides[i], &neighbour = pair.sides[1 - i];
                // By masks: compilers make branches of conditions, and these are as likely as not.
                OfSlot& list = of_slot_[side.slot];
                const std::uint32_t if_first = mask_of(list.begin == 0), if_listed = side.is_fixed - 1;
                const std::uint32_t end = (list.end & ~if_first) | (lists_end & if_first);
                list.begin |= end & if_first;
                lists_end += list.end & if_first;
                list.end = end - if_listed;
                slots_[end & if_listed] = neighbour.slot;
                boxes_[end & if_listed] = boxes[neighbour.is_fixed][neighbour.place];
            }
    }
    /// The items that pair with this one and are no sensors.
    NeighbourList<D> of(std::uint32_t slot) const {
        const OfSlot& list = of_slot_[slot];
        return {&boxes_[list.begin], &slots_[list.begin], list.begin != 0 ? list.end - list.begin : 0};
    }

    /// What `of` reads first, and where the list is, to fetch them from memory early.
    const void* data(std::uint32_t slot) const { return &of_slot_[slot]; }
    const void* list(std::uint32_t slot) const { return &boxes_[of_slot_[slot].begin]; }

    /// What is known of an item. Several threads may find out the same.
    enum class Center : std::uint8_t { unknown, covered, uncovered };
    std::atomic_ref<Center> center(std::uint32_t slot) { return std::atomic_ref(of_slot_[slot].center); }

    /// Whether another item may be near a contact of this one, whose centre is not covered as far as is known. Without
    /// a branch.
    bool may_matter(std::uint32_t slot) {
        const OfSlot& list = of_slot_[slot];
        const bool is_covered = center(slot).load(std::memory_order_relaxed) == Center::covered;
        return (list.begin != 0) & (list.end - list.begin >= 2) & !is_covered;
    }

    void reserve(std::size_t items, std::size_t near_pairs) {
        of_slot_.reserve(items);
        pairs_.reserve(near_pairs);
        slots_.reserve(lists_size(near_pairs));
        boxes_.reserve(lists_size(near_pairs));
    }

private:
    struct OfSlot {
        std::uint32_t begin;  ///< 0 if there is no list
        std::uint32_t end;    ///< while there is no list, its size
        Center center;
    };
    static constexpr std::size_t read_behind = 3;  ///< see NeighbourList
    static std::size_t lists_size(std::size_t pairs) { return 1 + 2 * pairs + read_behind; }
    static std::uint32_t mask_of(bool condition) { return ~static_cast<std::uint32_t>(condition) + 1; }

    std::vector<OfSlot> of_slot_;
    std::vector<NeighbourPair> pairs_;
    // The lists, from 1 on.
    std::vector<std::uint32_t> slots_;
    std::vector<Aabb<D>> boxes_;
};

}  // namespace abut::detail
