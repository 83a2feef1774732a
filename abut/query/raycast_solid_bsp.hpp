#pragma once

// Where does a ray come into a solid level?

#include <abut/query/raycast.hpp>
#include <abut/shape/solid_bsp.hpp>

namespace abut {

/// The first place where the ray comes from the open into the solid. One that starts on a face and goes in hits at 0;
/// one that starts inside comes out first, and `started_inside` tells so. One that runs along a face doesn't hit it.
/// The feature's part is the number of the face, where there is one.
///
/// That is of the level itself, where it was made. Placed by `at`, stretched, in a Compound or a World it is a shape
/// made of convex parts as others are: the ray hits one of those, whose number is told, also where it starts in
/// another.
template <int D>
std::optional<Hit<D>> raycast(const Ray<D>& ray, const SolidBsp<D>& level, const QueryOptions<D>&);

}  // namespace abut
