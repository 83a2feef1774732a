#pragma once

// Two polygons of few edges, or two boxes, of the plane: overlap, distance, contact and cached separation, each in one
// piece from the given shapes to the answer. Other shapes take placed polygons (convex/polygon_soa.hpp), which suit all
// shapes of the plane.

#include <abut/query/detail/closed_form/closed_form.hpp>

namespace abut::detail {

/// Unknown for other shapes, and if the fast path doesn't decide.
ClosedFormAnswer overlap_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache);

/// Tries the cached features first. Returns false, and leaves `result` unchanged, for other shapes, and if the fast
/// path doesn't decide.
bool closest_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, Cache* cache, Closest<2>& result);

/// The contact of the pair. It also returns false if the clipped edge belongs to the reference, or is a single point.
bool contact_polygons(const ShapeRef<2>& a, const ShapeRef<2>& b, double margin, Cache* cache, Contact<2>& result);

/// Whether the cached edge proves that they are farther apart than `reach`. False means unknown.
bool separated_by_cache(const ShapeRef<2>& a, const ShapeRef<2>& b, const Cache& cache, double reach);

}  // namespace abut::detail
