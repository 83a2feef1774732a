#pragma once

// Where a ray meets a shape of triangles. For .cpp files.

#include <abut/query/options.hpp>
#include <abut/query/raycast_part.hpp>
#include <abut/shape/view/view.hpp>

namespace abut {

/// The first triangle that the beam meets within reach, the lowest of those at one place: `found` tells whether there
/// is one. False, and nothing is told, where the shape isn't known by its triangles.
bool first_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                        PartHit<3>& first, bool& found);

/// Is told of one part that the beam meets; returns how far on they are still wanted: the new, shorter reach.
using HitVisitor = FunctionRef<double(const PartHit<3>& hit)>;

/// All triangles that the beam meets within reach, roughly the first first. False, and none was visited, where the
/// shape isn't known by its triangles.
bool each_triangle_hit(const DRay<3>& beam, const Composite<3>& composite, const QueryOptions<3>& options,
                       HitVisitor visit);

}  // namespace abut
