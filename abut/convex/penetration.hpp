#pragma once

// How deep two cores are in one another: the direction along which the least translation parts them.
//
// With h(n) the extent of A - B along a unit vector n, the depth is the least h(n) over all n. A polytope inside A - B
// grows towards the boundary where it is nearest to the origin (van den Bergen, "Proximity queries and penetration
// depth computation on 3D game objects", 2001). What is returned is always some h(n), so moving B by depth * normal
// truly parts them, whatever made the search stop.

#include <abut/convex/search_options.hpp>
#include <abut/convex/simplex.hpp>

#include <limits>

namespace abut {

enum class PenetrationExit : std::uint8_t {
    exact,          ///< the nearest face is one of A - B
    flat,           ///< A - B has no thickness along the normal: touching, or crossing without depth
    no_progress,    ///< rounding stopped it: the depth is valid, and the least that was seen
    bound_reached,  ///< the same, at the bound on steps
};

template <int D>
struct Penetration {
    PenetrationExit exit = PenetrationExit::bound_reached;
    DVec<D> normal{0.0};  ///< from A to B, of length 1
    double depth = 0;     ///< h(normal); below zero where the cores are apart after all
    double at_least = -std::numeric_limits<double>::infinity();  ///< no h(n) is below this
    Simplex<D> face;  ///< the face of A - B along the normal, weighted at the point nearest to the origin
};

/// The bound on growing steps; polytopes need a few, curved shapes some dozens.
inline constexpr std::size_t penetration_most_steps = 160;

/// Curved shapes come near their nearest face and never quite there: the search ends at this part of the depth.
inline constexpr double penetration_doubt = 1e-7;

/// Rolls on to where h is least nearby, from a normal found by growing a polytope: curved shapes come to the last
/// digits so, where growing takes a step for each new corner. Keeps the better of both; the face is no longer of the
/// normal. Gradient descent on the sphere; the slope of h at n is the farthest point along n, less its part along n.
template <int D>
void descend(const CoreDifference<D>& difference, Penetration<D>& found);

/// For cores that overlap or touch. In space it begins with `start` where that has a volume: four points of A - B, such
/// as GJK found around the origin; and the cache is told four that hold the nearest face and the origin, so that the
/// next search has less to grow. Never allocates but for the trace.
Penetration<2> penetration(const CoreDifference<2>& difference, const SearchOptions<2>& options = {},
                           const Simplex<2>* start = nullptr);
Penetration<3> penetration(const CoreDifference<3>& difference, const SearchOptions<3>& options = {},
                           const Simplex<3>* start = nullptr);

}  // namespace abut
