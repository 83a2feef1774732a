#pragma once

// A box against a box, both turned and moved and no more: all that is asked of them is answered from their axes.

#include <abut/convex/manifold.hpp>

namespace abut {

/// Whether these answers are for them: boxes as they are, or scaled alike along all axes, and not all but flat.
bool are_plain_boxes(const Convex<3>& a, const Convex<3>& b);

bool boxes_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options);

SignedDistance<3> distance_of_boxes(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options);

/// False where they are farther apart than `reach`. The points are those of `manifold`, under names of their own.
bool contact_of_boxes(const Convex<3>& a, const Convex<3>& b, double reach, double margin,
                      const SearchOptions<3>& options, SignedDistance<3>& distance, Manifold<3>& points);

}  // namespace abut
