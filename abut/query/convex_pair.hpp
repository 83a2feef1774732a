#pragma once

// The questions about two convex parts. Here alone is decided by which way a pair is answered: a closed form, the
// separating axes of boxes and polygons, or the searches that take any pair. All ways give the same answers. For .cpp
// files.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/manifold/manifold.hpp>

namespace abut {

/// Whether they have a point in common.
template <int D>
bool part_overlaps(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options);

template <int D>
SignedDistance<D> part_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options);

/// Where two parts meet.
template <int D>
struct PartContact {
    SignedDistance<D> distance;
    Manifold<D> manifold;
};

/// Whether they are at most `reach` apart, and then how far; the points are for `add_points`, where they aren't found
/// at once. `contact` is of no use otherwise.
template <int D>
bool part_touch(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                PartContact<D>& contact);

/// The points of two parts that touch, of those that are at most `margin` apart.
template <int D>
void add_points(const Convex<D>& a, const Convex<D>& b, double margin, const SearchOptions<D>& options,
                PartContact<D>& contact);

/// Both.
template <int D>
bool part_contact(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                  PartContact<D>& contact);

}  // namespace abut
