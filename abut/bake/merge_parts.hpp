#pragma once

// Fewer parts of many: hulls are joined where that adds least.

#include <abut/bake/gaps.hpp>
#include <abut/bake/rough_hull.hpp>

#include <cstddef>
#include <vector>

namespace abut {

/// A part in the making.
struct Lump {
    std::vector<DVec<3>> points;
    double volume = 0;       ///< of what is solid in it
    double hull_volume = 0;  ///< of its convex hull
    double thickness = 0;    ///< as that of a piece
    double gap = 0;          ///< how far its hull is from what it stands for
    bool whole = false;      ///< joined with others only if there are too many
};

/// Joins lumps two by two, first what adds least volume, until there are no more than `most`; and on, as long as the
/// hull of two is within `search.enough` of them.
void merge_parts(std::vector<Lump>& lumps, std::size_t most, const GapSearch& search, RoughHull& hull);

}  // namespace abut
