#pragma once

// Queries of pairs of parts of which one or both are known by a distance function (SDF). docs/decisions/0012 defines
// the answers. For .cpp files.
//
// Beside a convex set, in either order, the distance is the minimum of the function over the core, less the radius: the
// gap, or minus the depth of its deepest point. Beside a half-space it is the height of the shape's lowest point above
// the border. For two functions it is twice the minimum of the larger of both: where they overlap, minus the diameter
// of the largest ball in both.

#include <abut/query/detail/pair_dispatch.hpp>
#include <abut/query/detail/sdf/placed_function.hpp>
#include <abut/shape/view/part.hpp>

namespace abut::detail {

// One or both of the parts below are functions, in either order.

/// The tolerance of an answer about the pair, including the rounding of the coordinates at which the function is
/// evaluated.
template <int D>
double function_tolerance(const Part<D>& a, const Part<D>& b);

/// The tolerance of a distance found by a search; larger if a function gives no bounds.
template <int D>
double function_search_tolerance(const Part<D>& a, const Part<D>& b);

/// The precision that a caller needs. A distance of at most `sufficient` may be inexact, and one of more than `reach`
/// is reported as infinite. The distance is also infinite if a function has no bounds, and the other part is a
/// half-space or has no bounds either.
struct DistanceRequest {
    double sufficient = -std::numeric_limits<double>::infinity();
    double reach = std::numeric_limits<double>::infinity();
    double tolerance = 0;  ///< the distance may exceed the minimum by this
};

template <int D>
SignedDistance<D> function_distance(const Part<D>& a, const Part<D>& b, const DistanceRequest& request);

/// Stops at the first common point.
template <int D>
bool function_overlap(const Part<D>& a, const Part<D>& b);

/// The kinds of the two parts are in their order. The contact points on a convex set are those of its face towards the
/// function's shape.
template <int D>
bool function_contact(const Part<D>& a, const Part<D>& b, double reach, double margin, PartContact<D>& contact);

/// The distance of a set from a function, given the point of its core at which the function is lowest; all in the frame
/// of the placed function.
template <int D>
SignedDistance<D> distance_at_point(const Convex<D>& set, const PlacedFunction<D>& function, const DVec<D>& point,
                                    double distance);

}  // namespace abut::detail
