#pragma once

// How two objects stand to one another at one moment.

#include "objects.hpp"

#include <optional>
#include <vector>

namespace abut::tool {

/// How deep is nothing to speak of for a pair, and how near is too near.
struct Limits {
    std::optional<float> allow = {};  ///< by default 1e-3 of the smaller object's size
    float clearance = 0;
};

/// An object in a place of its own. Refers to all of it.
template <int D>
struct Standing {
    const Object<D>& object;
    const Pose<D>& pose;
    const View<D>& placed;
    const Aabb<D>& box;

    /// Where it is at the moment that was asked for last.
    explicit Standing(const Object<D>& there) : object(there), pose(there.pose), placed(there.placed), box(there.box) {}
    Standing(const Object<D>& what, const Pose<D>& where, const View<D>& view, const Aabb<D>& bounds)
        : object(what), pose(where), placed(view), box(bounds) {}
};

template <int D>
struct Meeting {
    float distance = 0;  ///< signed
    float allow = 0;     ///< what was allowed
    Vec<D> normal{};     ///< from a to b
    std::vector<Vec<D>> points;
    bool inside = false;  ///< a body is inside of the other, whose surface it meets nowhere, or no deeper than allowed
};

/// The size of the smaller of two objects.
template <int D>
float smaller_size(const Object<D>& a, const Object<D>& b);

/// How deep is nothing to speak of for two objects.
template <int D>
float allowed_depth(const Object<D>& a, const Object<D>& b, const Limits& limits);

/// Nothing where they are neither deeper in one another than is allowed nor nearer than the clearance.
template <int D>
std::optional<Meeting<D>> meeting(const Standing<D>& a, const Standing<D>& b, const Limits& limits);

}  // namespace abut::tool
