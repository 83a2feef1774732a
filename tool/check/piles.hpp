#pragma once

// Piles: many objects in one place, such as a scene whose transforms were lost when it was exported.

#include "tool/check/pair_contact.hpp"
#include "tool/check/pair_filter.hpp"
#include "tool/objects/objects.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::tool {

/// Objects that all contain one point deeper than allowed. So each two of them overlap, at least as deep as the sum of
/// their depths at the point.
template <int D>
struct Pile {
    std::vector<std::uint32_t> objects;  ///< sorted
    Vec<D> point{};
    float depth = 0;                  ///< at the point, of the object that is there least deep
    std::size_t first = 0, last = 0;  ///< frames
};

/// The least number of objects in a pile.
inline constexpr std::size_t min_pile = 32;

/// Finds piles and follows them from frame to frame.
template <int D>
class Piles {
public:
    /// Refers to all arguments.
    Piles(const Objects<D>& objects, const Limits& limits, const PairFilter& filter)
        : objects_(objects), limits_(limits), filter_(filter) {}

    /// Finds the piles of a frame among the objects that are present, by their boxes. Takes time in proportion to the
    /// number of objects, except for a tree of them.
    void find(std::span<const Aabb<D>> boxes, std::size_t frame);
    /// A frame without piles.
    void clear() { pile_of_.clear(); }

    /// True if the two are in one pile at the current frame.
    bool has(std::uint32_t a, std::uint32_t b) const {
        return !pile_of_.empty() && pile_of_[a] != none && pile_of_[a] == pile_of_[b];
    }

    const std::vector<Pile<D>>& all() const { return piles_; }

private:
    static constexpr std::uint32_t none = 0xffffffff;

    /// The objects around a point, without those of a pile.
    Pile<D> pile_at(const Vec<D>& point, std::span<const std::uint32_t> nearby);
    void add(Pile<D>&& pile, std::size_t frame);

    const Objects<D>& objects_;
    const Limits& limits_;
    const PairFilter& filter_;
    std::vector<std::uint32_t> pile_of_;  ///< number of each object's pile; empty: there are none
    std::vector<Pile<D>> piles_;
};

}  // namespace abut::tool
