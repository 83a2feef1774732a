#pragma once

// How far a triangle slides along a direction while it crosses another one. For .cpp files.

#include <abut/query/detail/solid/placed_solid.hpp>

namespace abut::detail {

/// B moved by `distance` along a direction crosses A for distances between the two ends. There it has the plane
/// dot(exit_normal, translation) == const, from A to B.
struct SlideInterval {
    double from = 0, to = 0;
    DVec<3> exit_normal{0.0};
};

/// The intervals that are wanted: those that begin before one distance and end beyond another.
struct SlideRange {
    double from_before, to_beyond;
};

/// Returns false if the triangles cross at no distance, or outside of the range. Triangles in one plane, which moves
/// along itself, cross while they share an area and face the same direction: then both solids are behind it.
bool slide_interval(const Corners& a, const Corners& b, const DVec<3>& direction, const SlideRange& range,
                    SlideInterval& interval);

}  // namespace abut::detail
