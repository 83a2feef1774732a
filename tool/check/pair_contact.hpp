#pragma once

// The contact of two objects at one time.

#include "tool/objects/objects.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace abut::tool {

/// The depth that is ignored, and the distance that is too close.
struct Limits {
    std::optional<float> allow = {};  ///< default: 1e-3 of the smaller object's size
    float clearance = 0;
};

/// An object at a pose. Refers to all arguments.
template <int D>
struct ObjectAt {
    const Object<D>& object;
    const Pose<D>& pose;
    const View<D>& placed;
    const Aabb<D>& box;

    /// The object at its current pose.
    explicit ObjectAt(const Object<D>& there) : object(there), pose(there.pose), placed(there.placed), box(there.box) {}
    ObjectAt(const Object<D>& what, const Pose<D>& where, const View<D>& view, const Aabb<D>& bounds)
        : object(what), pose(where), placed(view), box(bounds) {}
};

template <int D>
struct PairContact {
    float distance = 0;  ///< signed
    float allow = 0;     ///< the allowed depth
    Vec<D> normal{};     ///< from a to b
    std::vector<Vec<D>> points;
    bool inside = false;    ///< one body is inside the other without touching its surface deeper than allowed
    bool has_depth = true;  ///< false: it is deeper than allowed, and no more is known
};

/// Whether the depth of a contact is needed. Mostly it takes far less time to tell that it is more than allowed.
enum class Depth : std::uint8_t { needed, not_needed };

/// The bounding radius of the smaller object.
template <int D>
float smaller_size(const Object<D>& a, const Object<D>& b);

/// The depth that is ignored for two objects.
template <int D>
float allowed_depth(const Object<D>& a, const Object<D>& b, const Limits& limits);

/// Returns nothing if the objects are neither deeper than allowed nor closer than the clearance.
template <int D>
std::optional<PairContact<D>> pair_contact(const ObjectAt<D>& a, const ObjectAt<D>& b, const Limits& limits,
                                           Depth depth = Depth::needed);

}  // namespace abut::tool
