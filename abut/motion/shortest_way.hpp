#pragma once

// The shortest way out of several convex parts at once, as far as a search along lines finds it. For .cpp files.

#include <abut/motion/near_parts.hpp>

#include <array>

namespace abut {

template <int D>
struct ShortestWay {
    bool found = false;
    DVec<D> push{0.0};
    double depth = 0;  ///< at the start, of the deepest part
};

/// Along each of some directions, the first place that is free of all parts is found exactly: from each part that the
/// shape is in there is one way back to it along the line, and where that ends, the next ones are asked. From each such
/// place the shape slides back along what it touches there, towards where it began. The shortest push of all is kept.
/// The directions: out of each part and out of all at once, and evenly all around. Ends `gap` from what it was in.
///
/// Visits the parts in the world anew for each question, and allocates nothing. Bounds: 32 parts touched at a time, 256
/// parts along a line.
template <int D>
ShortestWay<D> shortest_way_out(const Convex<D>& shape, const World<D>& world, const Filter& filter, double gap);

}  // namespace abut
