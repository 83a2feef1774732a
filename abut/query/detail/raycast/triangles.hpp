#pragma once

// The hits of a ray with a shape of triangles. For .cpp files.

#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// The first triangle that the ray hits within reach, the lowest of those at one distance; `found` is whether there is
/// one. Returns false, and sets nothing, if the shape isn't known by its triangles.
bool first_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                        PartHit<3>& first, bool& found);

/// Receives one part that the ray hits; returns the new, shorter reach.
using HitVisitor = FunctionRef<double(const PartHit<3>& hit)>;

/// Visits all triangles that the ray hits within reach, roughly front to back. Returns false, and visits none, if the
/// shape isn't known by its triangles.
bool each_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                       HitVisitor visit);

}  // namespace abut::detail
