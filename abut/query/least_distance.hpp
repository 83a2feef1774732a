#pragma once

// Where a distance function is least: in a convex core, on the lower side of a plane, and beside another function. For
// .cpp files.
//
// Boxes are cut in two until none can hold less than what is known by more than the tolerance (branch and bound). What
// a box holds at least is told by the slope of the function, by the function itself (a field knows the samples around),
// and, in boxes as small as the details that are looked for, by how it changes and bends there. What is known is found
// by going down from the best places so far: to the corner that lies farthest down (Frank, Wolfe, "An algorithm for
// quadratic programming", 1956; Macklin et al., "Local optimization for robust signed distance field collision", 2020).

#include <abut/query/function_there.hpp>

namespace abut {

/// So many boxes are looked at before the best place known is taken for the answer: of a function that tells what it is
/// at least in a box, and of one that tells nothing.
inline constexpr int least_distance_most_boxes = 4096, least_distance_most_guesses = 2048;
/// And of a function that bounds itself, beside a convex set: in all, and for what is finer than a 10000th of the size.
inline constexpr int least_bounded_most_boxes = 512, least_bounded_most_fine_boxes = 48;

template <int D>
struct LeastOptions {
    double tolerance = 0;
    double off = 0;  ///< how far outside of a shape counts as on it
    /// A place where it is no more than that ends the search.
    double enough = -std::numeric_limits<double>::infinity();
    /// Of what is more than that nothing needs to be known.
    double reach = std::numeric_limits<double>::infinity();
    int most_boxes = 0;  ///< 0: the bound above that is the function's
    /// For `least_bounded`: once it is proven to be no less than that, fine boxes are no longer looked at.
    double no_less = std::numeric_limits<double>::infinity();
};

template <int D>
struct Least {
    double distance = std::numeric_limits<double>::infinity();  ///< where nothing is within reach; else where it is:
    DVec<D> point{0.0};
    int boxes = 0;  ///< that were looked at
    /// It may be so much less elsewhere: more than the tolerance only where the bound on boxes was reached.
    double doubt = 0;
    /// Nowhere less than that, and at most the reach: of `least_bounded`.
    double at_least = -std::numeric_limits<double>::infinity();
};

/// In the core of a convex set, without its radius, of a function that doesn't bound itself. All in one frame.
template <int D>
Least<D> least_in(const FunctionThere<D>& function, const Convex<D>& convex, const LeastOptions<D>& options);

/// The same for a function that bounds itself.
template <int D>
Least<D> least_bounded(const FunctionThere<D>& function, const Convex<D>& convex, const LeastOptions<D>& options);

/// The same in the hull of the core where it begins and where it ends.
template <int D>
Least<D> least_bounded(const FunctionThere<D>& function, const Convex<D>& first, const Convex<D>& last,
                       const LeastOptions<D>& options);

/// Of the places inside of the function's shape, where dot(normal, p) is least: that is the answer's `distance`.
/// `bounds` are those of the shape in the frame, and finite.
template <int D>
Least<D> lowest_inside(const FunctionThere<D>& function, const Aabb<D>& bounds, const DVec<D>& normal,
                       const LeastOptions<D>& options);

/// Where the larger of two is least, in a box.
template <int D>
Least<D> least_of_both(const FunctionThere<D>& a, const FunctionThere<D>& b, const Aabb<D>& box, double size,
                       const LeastOptions<D>& options);

}  // namespace abut
