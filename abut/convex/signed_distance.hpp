#pragma once

// The signed distance of two convex sets, in double: GJK between the cores, separating axes or the penetration search
// where they overlap, and the radii taken off at the end. An answer that isn't proven by two bounds that agree is asked
// for in another way.

#include <abut/convex/search_options.hpp>
#include <abut/convex/simplex.hpp>

namespace abut {

template <int D>
struct SignedDistance {
    double distance = 0;  ///< the gap, or minus the least translation that parts them
    DVec<D> normal;       ///< of length 1, from A to B
    DVec<D> on_a;         ///< in the world; on_b = on_a + distance * normal
    Simplex<D> face;      ///< the points of the cores that on_a and on_b are made of, relative to some origin

    DVec<D> on_b() const { return on_a + normal * distance; }
};

template <int D>
SignedDistance<D> signed_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options = {});

/// Whether they have a point in common.
template <int D>
bool convex_overlap(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options = {});

}  // namespace abut
