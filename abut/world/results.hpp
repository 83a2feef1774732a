#pragma once

// What a world reports: the events, contacts and impacts of an update, and the answers of queries.

#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/hit.hpp>
#include <abut/world/id.hpp>
#include <abut/world/id_lists.hpp>

#include <cstddef>
#include <span>

namespace abut {

/// The changes of an update. Each list is sorted and valid until the next update.
///
/// If one of two items is continuous, the pair also begins to touch if it touched during the motion since the last
/// update, even if the items have passed each other by now. During that motion, an item's position changes linearly and
/// its rotation at a constant rate along the shorter arc. A pair that touched only during the motion has no contact. It
/// ends in the next update in any case; if it touches again by then, it begins there as well. Items that were added or
/// got a new shape since the last update rest at their present pose. A pair that touched at the last update isn't
/// tested for the motion since.
struct Events {
    std::span<const IdPair> began;   ///< pairs that touch now and did not before
    std::span<const IdPair> stayed;  ///< pairs that touch now and did before
    std::span<const IdPair> ended;   ///< pairs that no longer touch, also if an item was removed
    /// The time of impact of each pair of `began`, as a fraction of the motion since the last update; 1 if only the
    /// present state was tested, such as for a pair without a continuous item.
    std::span<const float> fractions;
};

template <int D>
struct WorldContact {
    Id a, b;
    Contact<D> contact;
};

/// The impact of two items between two updates, as abut::sweep reports it for `a`: the normal faces `a`, and the point
/// is the point of contact at the time of impact.
template <int D>
struct WorldImpact {
    Id a, b;
    Hit<D> hit;
};

template <int D>
struct WorldHit {
    Id id;
    Hit<D> hit;
};

template <int D>
struct WorldClosest {
    Id id;
    Closest<D> closest;  ///< from the query's point or shape (A) to the item (B)
};

/// The work of the last update, in pairs.
struct UpdateCounts {
    std::size_t near = 0;    ///< pairs whose layers agree and whose AABBs, or swept AABBs if continuous, overlap
    std::size_t tested = 0;  ///< near pairs that were tested because an item had moved
    std::size_t balls = 0;   ///< tested pairs that bounding balls proved to be apart; depends on measurements
};

}  // namespace abut
