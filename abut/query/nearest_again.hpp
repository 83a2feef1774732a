#pragma once

// Two polygons of few sides, or boxes, of the plane that lay apart when they were asked about last, and still do: where
// the same corner is before the same side, or the same two corners face one another, that is all there is to find.

#include <abut/query/closest.hpp>

namespace abut {

/// False where it isn't so, or they are other shapes: `result` is as it was then.
bool nearest_again(const Given<2>& a, const Given<2>& b, Cache& cache, Closest<2>& result);

}  // namespace abut
