#pragma once

// Penetration depth of two cores by the expanding polytope algorithm (EPA).
//
// Let h(n) be the extent of the Minkowski difference A - B along a unit vector n. The depth is the minimum of h over
// all n. EPA expands a polytope inside A - B at its face nearest to the origin, until that face lies on the boundary of
// A - B (van den Bergen, "Proximity queries and penetration depth computation on 3D game objects", 2001). The result is
// always some h(n): moving B by depth * normal separates the two for every exit of the search.

#include <abut/convex/gjk/search_options.hpp>
#include <abut/convex/gjk/simplex.hpp>

#include <limits>

namespace abut::detail {

enum class EpaExit : std::uint8_t {
    exact,          ///< the nearest face is a face of A - B
    flat,           ///< A - B has no thickness along the normal: the cores touch, or cross without depth
    no_progress,    ///< rounding stopped the search: the depth is valid, and the smallest that was found
    bound_reached,  ///< as no_progress, at the bound on iterations
};

template <int D>
struct EpaResult {
    EpaExit exit = EpaExit::bound_reached;
    DVec<D> normal{0.0};                                            ///< from A to B, of length 1
    double depth = 0;                                               ///< h(normal); below zero if the cores are disjoint
    double lower_bound = -std::numeric_limits<double>::infinity();  ///< no h(n) is below this
    Simplex<D> face;  ///< the face of A - B along the normal, with the weights of its point nearest to the origin
};

/// The bound on iterations. Polytopes need a few, curved shapes some dozens.
inline constexpr std::size_t epa_max_iterations = 160;

/// The relative tolerance at which the search ends. On curved shapes the nearest face never reaches the boundary of A -
/// B.
inline constexpr double epa_tolerance = 1e-7;

/// Gradient descent of h on the unit sphere, from the normal that EPA found. It finds the last digits of the depth of
/// curved shapes, for which EPA needs an iteration per new vertex. The gradient of h at n is the support point along n,
/// less its component along n. `result` improves or stays as it is; its face no longer belongs to the normal.
template <int D>
void minimise_depth(const CoreDifference<D>& difference, EpaResult<D>& result);

/// The cores overlap or touch. In 3D the search begins with the tetrahedron `start`, such as the last simplex of GJK,
/// if it has a volume. The cache receives a tetrahedron that contains the nearest face and the origin, as the warm
/// start of the next query. The search allocates only for the trace.
EpaResult<2> epa(const CoreDifference<2>& difference, const SearchOptions<2>& options = {},
                 const Simplex<2>* start = nullptr);
EpaResult<3> epa(const CoreDifference<3>& difference, const SearchOptions<3>& options = {},
                 const Simplex<3>* start = nullptr);

}  // namespace abut::detail
