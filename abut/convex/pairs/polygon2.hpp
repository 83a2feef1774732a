#pragma once

// The closest features of two polygons of few edges, in double: all edges are tested as separating axes at once; if one
// separates the polygons, the closest features are a few steps from it.
//
// The steps are those of V-Clip (Mirtich 1998) in 2D. From two corners, or an edge and a corner, each step goes to the
// feature whose Voronoi region contains the other, until each lies in the region of the other. That proves the
// distance: the line through the two points is a normal of both. The region tests of vertices use the normals of the
// two edges, which are exact to the last digit, not differences of corners.

#include <abut/convex/gjk/cache.hpp>
#include <abut/convex/pairs/edge_gaps2.hpp>

#include <limits>

namespace abut::detail {

/// The closest features of two cores, or those of the minimum penetration, in the frame of the reference polygon.
struct ClosestFeatures2 {
    std::uint32_t of = 0;  ///< the reference polygon. 0: A, 1: B
    DVec<2> normal{0.0};   ///< of length 1, outwards from the reference
    double gap = 0;        ///< between the cores; below zero: penetration
    DVec<2> on_reference{0.0}, on_other{0.0};
    std::array<std::uint32_t, 2> reference_corners{},
        other_corners{};  ///< of the closest points, in the order of `PolygonSoa`
};

class PolygonPair {
public:
    /// Neither is a point. Both must outlive the pair.
    PolygonPair(const PlacedPolygon& a, const PlacedPolygon& b);

    enum class Answer {
        beyond,   ///< the distance is above `max_distance`
        within,   ///< the distance is at most `max_distance`; `closest` is set
        unknown,  ///< only the general algorithms can decide
    };

    /// The closest features.
    Answer find_closest(double max_distance, Cache* cache, ClosestFeatures2& closest) const;

    /// Only whether the distance is at most `max_distance`.
    Answer near(double max_distance, Cache* cache) const;

    const PlacedPolygon& polygon(std::uint32_t of) const { return *polygons_[of]; }
    const PolygonSoa& sides(std::uint32_t of) const { return polygons_[of]->sides; }
    /// The other polygon relative to this one.
    const Rigid2& seen_from(std::uint32_t of) const { return seen_[of]; }
    /// A corner of the other polygon, relative to this one.
    DVec<2> other_corner(std::uint32_t of, std::uint32_t i) const { return seen_[of].point(sides(1 - of).corner(i)); }

private:
    enum class Step { found, moved, failed };

    bool closest_by_cache(const Cache& cache, ClosestFeatures2& closest) const;
    bool walk_regions(std::array<std::uint32_t, 2> corners, int max_steps, ClosestFeatures2& closest) const;
    Step step_to_edge(std::uint32_t of, std::uint32_t side, std::array<std::uint32_t, 2>& corners,
                      ClosestFeatures2& closest) const;
    bool closest_when_apart(const EdgeGap& found, ClosestFeatures2& closest) const;
    bool closest_when_overlapping(const EdgeGap& found, ClosestFeatures2& closest) const;
    bool edges_suffice(const EdgeGap& found) const;
    bool separated_by_cache(const Cache& cache, double max_distance) const;
    void store(const ClosestFeatures2& closest, Cache* cache) const;
    void store_edge(const EdgeGap& found, Cache* cache) const;
    double scale() const;

    const PlacedPolygon* polygons_[2];
    Rigid2 seen_[2];
};

}  // namespace abut::detail
