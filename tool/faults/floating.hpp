#pragma once

// Finds objects that rest on nothing.

#include "tool/objects/level_view.hpp"

#include <cstddef>
#include <vector>

namespace abut::tool {

/// An object that touches no other, though one is below it.
template <int D>
struct FloatingObject {
    std::size_t object = 0;
    std::size_t nearest = 0;  ///< the nearest object among those below it
    float distance = 0;       ///< between the two
    Vec<D> position{};        ///< the object's point nearest to it
};

/// Objects that are farther from all others than `tolerance` times their size. What has nothing below it, such as the
/// lowest ground, floats on purpose. `up` is a unit vector along an axis.
template <int D>
std::vector<FloatingObject<D>> find_floating(const std::vector<ViewedObject<D>>& objects, const Vec<D>& up,
                                             float tolerance = 0.01f);

}  // namespace abut::tool
