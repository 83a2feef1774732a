#pragma once

// Two polygons of few sides, or two boxes, of the plane: whether they overlap, how far apart they are, and whether they
// still are, each in one piece from the shapes as they were given to the answer. Outlines (convex/polygon_soa.hpp),
// which suit all shapes of the plane, are made where this is not enough.

#include <abut/query/direct.hpp>

namespace abut {

/// Unknown of other shapes, and where the answer isn't found at once.
DirectAnswer overlap_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache);

/// Looks first at what was nearest last time. False where the answer isn't found at once, or they are other shapes:
/// `result` is as it was then.
bool closest_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result);

/// The same of contacts. Not where the edge that is cut off is one of the reference's own, or has but a point left.
bool contact_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, double margin, Cache* cache, Contact<2>& result);

/// Whether they are farther apart than `reach`, as the side that parted them last proves. False: not known.
bool parted_again(const ShapeRef<2>& a, const ShapeRef<2>& b, const Cache& cache, double reach);

}  // namespace abut
