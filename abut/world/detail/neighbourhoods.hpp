#pragma once

// The neighbours of a world's items, which together form the surfaces that an item touches. For .cpp files.

#include <abut/math/aabb.hpp>
#include <abut/math/simd/lanes-inl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut::detail {

/// An item near another one.
template <int D>
struct Neighbour {
    Aabb<D> box;
    std::uint32_t slot;

    /// A box, for the tests: of each of the two boxes, no minimum exceeds a maximum of the other.
    class Query {
    public:
        explicit Query(const Aabb<D>& box) {
            constexpr float infinity = std::numeric_limits<float>::infinity();
            std::array<float, 4> max, min;
            max.fill(infinity);
            min.fill(-infinity);
            for (int i = 0; i < D; ++i) {
                max[static_cast<std::size_t>(i)] = box.max[i];
                min[static_cast<std::size_t>(i + 4 - D)] = box.min[i];
            }
            max_ = {max[0], max[1], max[2], max[3]};
            min_ = {min[0], min[1], min[2], min[3]};
        }
        bool overlaps(const Neighbour& neighbour) const {
            static_assert(sizeof(Aabb<D>) == 2 * D * sizeof(float));
            const float* const sides = &neighbour.box.min[0];
            const std::uint32_t below = lanes::bits(lanes::at(sides) <= max_);
            const std::uint32_t above = lanes::bits(lanes::at(sides + 2 * D - 4) >= min_);
            return (below & above) == 0xF;
        }

    private:
        lanes::Floats4 max_, min_;  // the first and the last four of a box's sides are compared with them
    };
};

/// The neighbours of all items that have several, in an update that filters internal edges.
template <int D>
class Neighbourhoods {
public:
    void begin_update(std::size_t items) {
        static_assert(std::is_trivially_copyable_v<OfSlot>);
        of_slot_.resize(items);
        if (items > 0) std::memset(static_cast<void*>(of_slot_.data()), 0, items * sizeof(OfSlot));
        end_ = 1;
    }
    /// Counts an item near this one, which may be a neighbour.
    void count(std::uint32_t slot) { ++of_slot_[slot].end; }
    /// Call this when all are counted.
    void begin_lists(std::size_t near_pairs) { neighbours_.resize(std::max(neighbours_.size(), 1 + 2 * near_pairs)); }
    bool may_have_several(std::uint32_t slot) const { return of_slot_[slot].begin != 0 || of_slot_[slot].end > 1; }
    /// Adds a neighbour of an item that may have several. Lists that begin after one another lie beside each other.
    void add(std::uint32_t slot, std::uint32_t neighbour, const Aabb<D>& box) {
        OfSlot& list = of_slot_[slot];
        if (list.begin == 0) {
            list.begin = std::exchange(end_, end_ + list.end);
            list.end = list.begin;
        }
        // Member by member: a neighbour that is made beside the list is read before it is written.
        Neighbour<D>& added = neighbours_[list.end++];
        added.box = box;
        added.slot = neighbour;
    }
    /// The items that pair with this one and are no sensors, if they may be several.
    std::span<const Neighbour<D>> of(std::uint32_t slot) const {
        const OfSlot& list = of_slot_[slot];
        if (list.begin == 0) return {};
        return std::span(neighbours_).subspan(list.begin, list.end - list.begin);
    }

    /// What `of` reads first, and where the list is, to fetch them from memory early.
    const void* data(std::uint32_t slot) const { return &of_slot_[slot]; }
    const void* list(std::uint32_t slot) const { return neighbours_.data() + of_slot_[slot].begin; }

    // What is known of an item. Several threads may find out the same.

    /// The index of the id of the neighbour that ended the last search for the point nearest to a contact, likely the
    /// next; 0 at first.
    std::atomic_ref<std::uint32_t> last_cover(std::uint32_t slot) { return std::atomic_ref(of_slot_[slot].last_cover); }
    enum class Center : std::uint8_t { unknown, covered, uncovered };
    std::atomic_ref<Center> center(std::uint32_t slot) { return std::atomic_ref(of_slot_[slot].center); }

    void reserve(std::size_t items, std::size_t near_pairs) {
        of_slot_.reserve(items);
        neighbours_.reserve(1 + 2 * near_pairs);
    }

private:
    struct OfSlot {
        std::uint32_t begin;  ///< in neighbours_; 0 if there is no list
        std::uint32_t end;    ///< while there is no list, the count of items near
        std::uint32_t last_cover;
        Center center;
    };
    std::vector<OfSlot> of_slot_;
    std::vector<Neighbour<D>> neighbours_;  // from 1 on
    std::uint32_t end_ = 1;                 // of the lists so far
};

}  // namespace abut::detail
