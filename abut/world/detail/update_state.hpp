#pragma once

// What a world needs during an update, beside its results. For .cpp files.

#include <abut/math/simd/float4-inl.h>
#include <abut/query/detail/surface/surface_contacts.hpp>
#include <abut/world/detail/deferred_work.hpp>
#include <abut/world/detail/pair_results.hpp>
#include <abut/world/detail/slot_cache.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace abut::detail {

/// An item near another one. Its AABB is stored so that D - 1 comparisons of four floats test for overlap.
template <int D>
class Neighbour {
public:
    Neighbour() = default;
    Neighbour(std::uint32_t item, const Aabb<D>& box) : slot(item) {
        for (std::size_t i = 0; i < sides_.size(); ++i) sides_[i] = side(box.min, box.max, i);
    }

    /// A box, for the tests.
    class Query {
    public:
        explicit Query(const Aabb<D>& box) {
            const auto at = [&](std::size_t i) { return side(box.max, box.min, i); };
            for (std::size_t i = 0; i < rows_.size(); ++i)
                rows_[i] = float4::Floats{at(2 * i), at(2 * i + 1), at(2 * i + 2), at(2 * i + 3)};
        }
        bool overlaps(const Neighbour& neighbour) const {
            float4::Mask overlap{-1, -1, -1, -1};
            for (std::size_t i = 0; i < rows_.size(); ++i)
                overlap &= float4::load(neighbour.sides_.data() + 2 * i) <= rows_[i];
            return float4::bits(overlap) == 0xF;
        }

    private:
        std::array<float4::Floats, D - 1> rows_;  // sides 0 to 3, and 2 to 5
    };

    std::uint32_t slot;

private:
    /// Boxes overlap if no side of one, a minimum or a negative maximum, exceeds that of the other turned around.
    static float side(const Vec<D>& first, const Vec<D>& second, std::size_t i) {
        const int axis = static_cast<int>(i) % D;
        return i < static_cast<std::size_t>(D) ? first[axis] : -second[axis];
    }

    std::array<float, 2 * D> sides_;
};

/// The neighbours of all items, in an update that filters internal edges.
template <int D>
class Neighbourhoods {
public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    void begin_update(std::size_t items) { of_slot_.assign(items + 1, {}); }
    void count(std::uint32_t slot) { ++of_slot_[slot + 1].begin; }
    /// Reserves the places of the neighbours that were counted.
    void place() {
        std::uint32_t count = 0;
        for (OfSlot& of_slot : of_slot_) count += std::exchange(of_slot.begin, count);
        neighbours_.resize(count);
    }
    void add(std::uint32_t slot, const Neighbour<D>& neighbour) { neighbours_[of_slot_[slot + 1].begin++] = neighbour; }
    /// The items that pair with this one and are no sensors.
    std::span<const Neighbour<D>> of(std::uint32_t slot) const {
        const std::uint32_t begin = of_slot_[slot].begin;
        return std::span(neighbours_).subspan(begin, of_slot_[slot + 1].begin - begin);
    }

    // What is known of an item. Several threads may find out the same.

    /// The neighbour that ended the last search for the point nearest to a contact, likely the next; none at first.
    std::atomic_ref<std::uint32_t> last_cover(std::uint32_t slot) { return std::atomic_ref(of_slot_[slot].last_cover); }
    enum class Center : std::uint32_t { unknown, covered, uncovered };
    std::atomic_ref<Center> center(std::uint32_t slot) { return std::atomic_ref(of_slot_[slot].center); }

    void reserve(std::size_t items, std::size_t near_pairs) {
        of_slot_.reserve(items + 1);
        neighbours_.reserve(2 * near_pairs);
    }

private:
    struct OfSlot {
        /// In neighbours_. Until add() their number is in the next slot's, and then their end so far.
        std::uint32_t begin = 0;
        std::uint32_t last_cover = none;
        Center center = Center::unknown;
    };
    std::vector<OfSlot> of_slot_;  // and one more
    std::vector<Neighbour<D>> neighbours_;
};

/// A contact of items without parts that isn't filtered yet, by its index among those found, and for which of its items
/// it needs that.
template <int D>
struct UnfilteredContact {
    std::uint32_t found;
    bool for_a, for_b;
    DeepestParts<D> deepest;
};

/// What one thread remembers between tests of pairs.
template <int D>
struct PairTestMemory {
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    /// Contacts are filtered together, so that the code of either step stays in the instruction cache.
    static constexpr std::size_t max_unfiltered = 32;

    SlotCache<View<D>> views{1024};  ///< fits in the second cache of common processors
    /// Of the first item of the last pair. Pairs are sorted, so consecutive pairs share it.
    std::uint32_t first_slot = none;
    View<D> first;
    std::array<UnfilteredContact<D>, max_unfiltered> unfiltered;
    std::size_t unfiltered_count = 0;
    /// The points nearest to the centres of items, for contacts of which an item is A or B.
    std::array<SlotCache<NearestToCenter<D>>, 2> nearest{SlotCache<NearestToCenter<D>>{256},
                                                         SlotCache<NearestToCenter<D>>{256}};

    void clear() {
        views.clear();
        first_slot = none;
        for (auto& of_side : nearest) of_side.clear();
    }
    /// Where the parts of the next contact go.
    DeepestParts<D>& next_deepest() { return *std::construct_at(&unfiltered[unfiltered_count].deepest); }
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
    std::vector<PairResults<D>> later_parts;  ///< all but the first
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
