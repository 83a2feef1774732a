#pragma once

// The shortest push out of several convex parts at once, by a search along lines. For .cpp files.

#include <abut/motion/mover/nearby_parts.hpp>

#include <array>

namespace abut::detail {

template <int D>
struct ShortestPush {
    bool found = false;
    DVec<D> push{0.0};
    double depth = 0;  ///< penetration depth of the deepest part at the start
};

/// For each search direction the first free point on the line is found exactly: each overlapped part gives an exit, and
/// parts overlapped at the exit are tested next. From each free point the shape slides back along its contacts towards
/// the start. The shortest push wins. Directions: out of each part, out of all at once, and evenly spread ones. The
/// result is `gap` away from the obstacles.
///
/// Queries the world anew for each step and doesn't allocate. Limits: 32 contacts at a time, 256 parts along a line.
template <int D>
ShortestPush<D> shortest_push(const Convex<D>& shape, const World<D>& world, const Filter& filter, double gap);

}  // namespace abut::detail
