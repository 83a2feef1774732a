#pragma once

// The minimum of a distance function: in a convex core, along a plane's normal, and jointly with another function. For
// .cpp files.
//
// Boxes are cut in two until none can hold less than the best value by more than the tolerance (branch and bound). The
// lower bound of a box comes from the function itself if it bounds itself (a field knows the samples around), else from
// its slope and, in boxes as small as the smallest details, from an estimate of its gradient and curvature. Descents
// improve the best value.

#include <abut/query/detail/sdf/placed_function.hpp>

namespace abut::detail {

template <int D>
struct MinimumOptions {
    double tolerance = 0;
    /// The search ends at a value of at most this.
    double sufficient = -std::numeric_limits<double>::infinity();
    /// Values above this don't matter.
    double reach = std::numeric_limits<double>::infinity();
    int max_boxes = 0;  ///< at which the best point so far is the answer; 0: the limit of the search
    /// Once the minimum in a convex set is proven to be at least this, fine boxes are skipped.
    double sufficient_bound = std::numeric_limits<double>::infinity();
    /// A point of the convex set, at the end of its path, near the minimum; or null.
    const DVec<D>* hint = nullptr;
};

template <int D>
struct Minimum {
    double distance = std::numeric_limits<double>::infinity();  ///< infinite if nothing is within reach
    DVec<D> point{0.0};
    double share = 0;  ///< of its path, at which the convex set contains the point
    int boxes = 0;     ///< the number of boxes processed
    /// The minimum may be lower by this: by more than the tolerance only if the limit on boxes was reached.
    double uncertainty = 0;
    /// The minimum is at least this, at most the reach.
    double lower_bound = -std::numeric_limits<double>::infinity();
};

/// The minimum over the core of a convex set, without its radius. All in one frame.
template <int D>
Minimum<D> minimum_in_convex(const PlacedFunction<D>& function, const Convex<D>& convex,
                             const MinimumOptions<D>& options);

/// The minimum over the hull of the core at the start and at the end of its path.
template <int D>
Minimum<D> minimum_in_convex(const PlacedFunction<D>& function, const Convex<D>& first, const Convex<D>& last,
                             const MinimumOptions<D>& options);

/// The minimum in a box of the larger of two functions. `size` is that of the smaller shape.
template <int D>
Minimum<D> minimum_of_larger(const PlacedFunction<D>& a, const PlacedFunction<D>& b, const Aabb<D>& box, double size,
                             const MinimumOptions<D>& options);

/// The lowest point inside the function's shape: `distance` is the minimum of dot(normal, p). Points outside of the
/// shape by `surface_tolerance` count as on it. `bounds` are finite, and those of the shape in the frame.
template <int D>
Minimum<D> lowest_inside(const PlacedFunction<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                         double surface_tolerance, const MinimumOptions<D>& options);

}  // namespace abut::detail
