#pragma once

// The sets of rings that contain a point.

#include <cstdint>
#include <vector>

namespace abut::outline {

/// Sets of ring numbers; ring 0 is the outline, the others are holes. A set is stored as another set and one more ring,
/// so entering and leaving a ring is a step in a tree.
class RingSets {
public:
    static constexpr std::uint32_t nothing = 0;

    /// The symmetric difference of the set and the ring.
    std::uint32_t toggled(std::uint32_t set, std::uint32_t ring) {
        if (sets_[set].ring == ring && set != nothing) return sets_[set].parent;
        std::uint32_t at = set;
        while (at != nothing && sets_[at].ring != ring) at = sets_[at].parent;
        if (at == nothing) return with(set, ring);
        later_rings_.clear();
        for (std::uint32_t i = set; i != at; i = sets_[i].parent) later_rings_.push_back(sets_[i].ring);
        std::uint32_t result = sets_[at].parent;
        for (std::size_t i = later_rings_.size(); i-- > 0;) result = with(result, later_rings_[i]);
        return result;
    }

    /// True for points in the outline and in no hole.
    bool solid(std::uint32_t set) const { return sets_[set].in_outline && sets_[set].holes == 0; }

private:
    struct Set {
        std::uint32_t ring, parent, holes;
        bool in_outline;
    };

    std::uint32_t with(std::uint32_t set, std::uint32_t ring) {
        const Set& parent = sets_[set];
        sets_.push_back({ring, set, parent.holes + (ring > 0 ? 1 : 0), parent.in_outline || ring == 0});
        return static_cast<std::uint32_t>(sets_.size() - 1);
    }

    std::vector<Set> sets_{{0, 0, 0, false}};
    std::vector<std::uint32_t> later_rings_;
};

}  // namespace abut::outline
