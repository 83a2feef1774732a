#pragma once

// The minimum of a distance function: in a convex core, along a plane's normal, and jointly with another function. For
// .cpp files.
//
// Boxes are split until none can hold less than the best value by more than the tolerance (branch and bound). The lower
// bound of a box comes from the slope of the function, from the function itself (a field knows the samples around),
// and, in boxes as small as the smallest details, from an estimate of its gradient and curvature. Descents improve the
// best value: each goes to the corner farthest down (Frank, Wolfe, "An algorithm for quadratic programming", 1956;
// Macklin et al., "Local optimization for robust signed distance field collision", 2020).

#include <abut/query/detail/sdf/placed_function.hpp>

namespace abut::detail {

/// The limits on boxes, at which the best point so far is the answer: for a function that bounds itself in a box, and
/// for one that doesn't.
inline constexpr int max_boxes_with_bounds = 4096, max_boxes_without_bounds = 2048;
/// The limits for a function that bounds itself, beside a convex set: in all, and for details finer than a 10000th of
/// the size.
inline constexpr int bounded_minimum_max_boxes = 512, bounded_minimum_max_fine_boxes = 48;

template <int D>
struct MinimumOptions {
    double tolerance = 0;
    double surface_tolerance = 0;  ///< points outside of a shape by up to this count as on it
    /// The search ends at a value of at most this.
    double sufficient = -std::numeric_limits<double>::infinity();
    /// Values above this don't matter.
    double reach = std::numeric_limits<double>::infinity();
    int max_boxes = 0;  ///< 0: the limit above for the function
    /// For `bounded_minimum`: once the minimum is proven to be at least this, fine boxes are skipped.
    double sufficient_bound = std::numeric_limits<double>::infinity();
    /// For `bounded_minimum`: a point of the set, at the end of its path, near the minimum; or null.
    const DVec<D>* hint = nullptr;
};

template <int D>
struct Minimum {
    double distance = std::numeric_limits<double>::infinity();  ///< infinite if nothing is within reach
    DVec<D> point{0.0};
    double share = 0;  ///< of its path, at which the set contains the point; set by `bounded_minimum`
    int boxes = 0;     ///< the number of boxes processed
    /// The minimum may be lower by this: by more than the tolerance only if the limit on boxes was reached.
    double uncertainty = 0;
    /// The minimum is at least this, at most the reach; set by `bounded_minimum`.
    double lower_bound = -std::numeric_limits<double>::infinity();
};

/// The minimum over the core of a convex set, without its radius, for a function that doesn't bound itself. All in one
/// frame.
template <int D>
Minimum<D> minimum_in_convex(const PlacedFunction<D>& function, const Convex<D>& convex,
                             const MinimumOptions<D>& options);

/// The minimum over the core for a function that bounds itself.
template <int D>
Minimum<D> bounded_minimum(const PlacedFunction<D>& function, const Convex<D>& convex,
                           const MinimumOptions<D>& options);

/// The minimum over the hull of the core at the start and at the end of its path.
template <int D>
Minimum<D> bounded_minimum(const PlacedFunction<D>& function, const Convex<D>& first, const Convex<D>& last,
                           const MinimumOptions<D>& options);

/// The lowest point inside the function's shape: `distance` is the minimum of dot(normal, p). `bounds` are finite, and
/// those of the shape in the frame.
template <int D>
Minimum<D> lowest_inside(const PlacedFunction<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                         const MinimumOptions<D>& options);

/// The minimum in a box of the larger of two functions.
template <int D>
Minimum<D> minimum_of_larger(const PlacedFunction<D>& a, const PlacedFunction<D>& b, const Aabb<D>& box, double size,
                             const MinimumOptions<D>& options);

}  // namespace abut::detail
