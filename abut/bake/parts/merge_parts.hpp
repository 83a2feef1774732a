#pragma once

// Reduces the number of parts by merging those whose common hull adds the least volume.

#include <abut/bake/parts/approximate_hull.hpp>
#include <abut/bake/parts/concavity.hpp>

#include <cstddef>
#include <vector>

namespace abut::detail {

/// A part before its final hull is built.
struct MergePart {
    std::vector<DVec<3>> points;
    double volume = 0;                 ///< solid volume
    double hull_volume = 0;            ///< volume of the convex hull
    double thickness = 0;              ///< as that of a piece
    double hull_distance = 0;          ///< distance of the hull from its contents
    bool is_convex_component = false;  ///< merged with others only if there are too many parts
};

/// Merges pairs of parts, smallest added volume first, until at most `max_parts` are left. It continues while the hull
/// of a pair is within `threshold.limit` of the pair.
void merge_parts(std::vector<MergePart>& parts, std::size_t max_parts, const DistanceThreshold& threshold,
                 ApproximateHull& hull);

}  // namespace abut::detail
