#pragma once

// The neighbours of a world's items, which together form the surfaces that an item touches. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/simd/lanes-inl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
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
                rows_[i] = lanes::Floats4{at(2 * i), at(2 * i + 1), at(2 * i + 2), at(2 * i + 3)};
        }
        bool overlaps(const Neighbour& neighbour) const {
            std::uint32_t overlap = 0xF;
            for (std::size_t i = 0; i < rows_.size(); ++i)
                overlap &= lanes::bits(lanes::at(neighbour.sides_.data() + 2 * i) <= rows_[i]);
            return overlap == 0xF;
        }

    private:
        std::array<lanes::Floats4, D - 1> rows_;  // sides 0 to 3, and 2 to 5
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

/// The neighbours of all items that have several, in an update that filters internal edges.
template <int D>
class Neighbourhoods {
public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    void begin_update(std::size_t items) {
        of_slot_.assign(items, {});
        end_ = 0;
    }
    /// Counts an item near this one, which may be a neighbour.
    void count(std::uint32_t slot) { ++of_slot_[slot].end; }
    /// Call this when all are counted.
    void begin_lists(std::size_t near_pairs) { neighbours_.resize(std::max(neighbours_.size(), 2 * near_pairs)); }
    bool may_have_several(std::uint32_t slot) const { return of_slot_[slot].begin != none || of_slot_[slot].end > 1; }
    /// Adds a neighbour of an item that may have several. Lists that begin after one another lie beside each other.
    void add(std::uint32_t slot, const Neighbour<D>& neighbour) {
        OfSlot& list = of_slot_[slot];
        if (list.begin == none) {
            list.begin = std::exchange(end_, end_ + list.end);
            list.end = list.begin;
        }
        neighbours_[list.end++] = neighbour;
    }
    /// The items that pair with this one and are no sensors, if they may be several.
    std::span<const Neighbour<D>> of(std::uint32_t slot) const {
        const auto& [begin, end, last_cover, center] = of_slot_[slot];
        if (begin == none) return {};
        return std::span(neighbours_).subspan(begin, end - begin);
    }

    /// Where `of` reads first, to fetch it from memory early.
    const void* data(std::uint32_t slot) const { return &of_slot_[slot]; }

    // What is known of an item. Several threads may find out the same.

    /// The neighbour that ended the last search for the point nearest to a contact, likely the next; none at first.
    std::atomic_ref<std::uint32_t> last_cover(std::uint32_t slot) { return std::atomic_ref(of_slot_[slot].last_cover); }
    enum class Center : std::uint8_t { unknown, covered, uncovered };
    std::atomic_ref<Center> center(std::uint32_t slot) { return std::atomic_ref(of_slot_[slot].center); }

    void reserve(std::size_t items, std::size_t near_pairs) {
        of_slot_.reserve(items);
        neighbours_.reserve(2 * near_pairs);
    }

private:
    struct OfSlot {
        std::uint32_t begin = none;  ///< in neighbours_
        std::uint32_t end = 0;       ///< while there is no list, the count of items near
        std::uint32_t last_cover = none;
        Center center = Center::unknown;
    };
    std::vector<OfSlot> of_slot_;
    std::uint32_t end_ = 0;  // of the lists so far
    std::vector<Neighbour<D>> neighbours_;
};

}  // namespace abut::detail
