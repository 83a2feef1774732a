#pragma once

// The first hit of a ray with a solid level.

#include <abut/query/raycast.hpp>
#include <abut/shape/solid_bsp.hpp>

namespace abut {

/// The first point where the ray passes from open space into the solid. A ray that starts on a face and goes in hits at
/// 0. A ray that starts inside leaves the solid first, and sets `started_inside`. A ray along a face doesn't hit it.
/// The feature's part is the number of the face, if there is one.
///
/// This holds for the level itself, without a pose. Placed by `at`, stretched, in a Compound or in a World, the level
/// is a shape of convex parts like others: the ray hits one of them, also if it starts inside another, and the
/// feature's part is its number.
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const SolidBsp<D>& level, const QueryOptions<D>&);

}  // namespace abut
