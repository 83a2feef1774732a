#pragma once

// The memory of a world's filter of internal edges during an update. For .cpp files.

#include <abut/math/simd/float4-inl.h>
#include <abut/query/detail/surface/surface_contacts.hpp>

#include <algorithm>
#include <array>
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

/// What searches around an item with several neighbours remember.
template <int D>
struct NeighbourSearch {
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    NearestToCenter<D> nearest_to_center;
    std::uint32_t last_cover = none;  ///< the neighbour that ended the last search, likely the next
    bool is_center_tested = false;    ///< for neighbours that contain it
    bool is_center_covered = false;
};

/// A contact of items without parts that isn't filtered yet, by its index in World::found_, and for which of its items
/// it needs that.
template <int D>
struct UnfilteredContact {
    std::uint32_t found;
    bool for_a, for_b;
    DeepestParts<D> deepest;
};

template <int D>
struct EdgeFilterState {
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    /// The neighbours of an item: the items that pair with it and are no sensors. They end where those of the next slot
    /// begin. Until add_neighbour() their number is stored there, and then their end so far.
    struct Neighbours {
        std::uint32_t begin = 0;      ///< in neighbours
        std::uint32_t search = none;  ///< in searches
    };
    /// Contacts are filtered together, so that the code of either step stays in the instruction cache.
    static constexpr std::size_t max_unfiltered = 32;

    std::vector<Neighbours> neighbours_of_slot;  ///< and one more
    std::vector<Neighbour<D>> neighbours;
    std::vector<NeighbourSearch<D>> searches;
    std::array<UnfilteredContact<D>, max_unfiltered> unfiltered;
    std::size_t unfiltered_count = 0;
    /// The contacts of each item, in an update with substitute normals: contact i of World::found_ has the places 2 i
    /// (for its A) and 2 i + 1 (for its B) in found_before, which refer to the item's place before.
    std::vector<std::uint32_t> last_found;  ///< by slot
    std::vector<std::uint32_t> found_before;
    std::vector<char> neighbour_changed;  ///< by slot: an item near it has changed since the last update
    bool neighbour_changed_is_known = false;

    void begin_update(std::size_t items) {
        neighbours_of_slot.assign(items + 1, {});
        searches.clear();
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
    void count_neighbour(std::uint32_t slot) { ++neighbours_of_slot[slot + 1].begin; }
    /// Reserves the places of the neighbours that were counted.
    void place_neighbours() {
        std::uint32_t count = 0;
        std::size_t with_search = 0;
        for (Neighbours& of_slot : neighbours_of_slot) {
            with_search += of_slot.begin < 2 ? 0 : 1;
            count += std::exchange(of_slot.begin, count);
        }
        neighbours.resize(count);
        searches.reserve(with_search);  // references to their elements stay valid during the update
    }
    void add_neighbour(std::uint32_t slot, const Neighbour<D>& neighbour) {
        neighbours[neighbours_of_slot[slot + 1].begin++] = neighbour;
    }
    std::span<const Neighbour<D>> neighbours_of(std::uint32_t slot) const {
        const std::uint32_t begin = neighbours_of_slot[slot].begin;
        return std::span(neighbours).subspan(begin, neighbours_of_slot[slot + 1].begin - begin);
    }
    bool is_center_known_covered(std::uint32_t slot) const {
        const std::uint32_t search = neighbours_of_slot[slot].search;
        return search != none && searches[search].is_center_covered;
    }
    /// Valid until the next update.
    NeighbourSearch<D>& search_of(std::uint32_t slot) {
        std::uint32_t& search = neighbours_of_slot[slot].search;
        if (search == none) {
            search = static_cast<std::uint32_t>(searches.size());
            searches.emplace_back();
        }
        return searches[search];
    }

    /// Reserves memory for the worst case of a scene of this size: all its pairs change, and all contacts are ghosts.
    void reserve(std::size_t items, std::size_t near_pairs, std::size_t contacts) {
        neighbours_of_slot.reserve(items + 1);
        searches.reserve(std::min(items, near_pairs));
        neighbours.reserve(2 * near_pairs);
        last_found.reserve(items);
        found_before.reserve(2 * contacts);
        neighbour_changed.reserve(items);
    }
};

}  // namespace abut::detail
