#pragma once

// Raycasts and sweeps against shapes known by a distance function. For .cpp files.
//
// A ray advances by the distance (sphere tracing; Hart, "Sphere tracing: a geometric method for the antialiased ray
// tracing of implicit surfaces", 1996), or from cell to cell if the function has cells. A moving shape advances by its
// distance over the maximum speed of its points (conservative advancement; Mirtich, "Impulse-based dynamic simulation",
// 1996). Steps are limited: once half of them are used up, each covers at least its share of the remaining length, so
// thinner features may be missed. Rays never miss the walls of a field.

#include <abut/query/detail/raycast/part_hit.hpp>
#include <abut/query/detail/sdf/function_pairs.hpp>
#include <abut/query/detail/sweep/linear.hpp>
#include <abut/query/detail/sweep/rotating.hpp>

namespace abut::detail {

/// The limit on steps of a ray; each step evaluates a distance.
inline constexpr int function_ray_max_iterations = 1024;

template <int D>
bool part_hit(const DRay<D>& beam, const DistanceFunction<D>& part, PartHit<D>& hit);

// Below, one or both of the parts are functions, and neither or one of them is a half-space.

template <int D>
bool function_time_of_impact(const AnyPart<D>& a, const Path<D>& path, const AnyPart<D>& b, std::uint32_t index,
                             LinearImpact<D>& impact);

/// `limits.from` and `limits.max_iterations` don't matter.
template <int D>
bool function_time_of_impact(const AnyPart<D>& a, const RigidPath<D>& path_a, const AnyPart<D>& b,
                             const RigidPath<D>& path_b, const RotatingSweepLimits& limits, RotatingImpact<D>& impact);

}  // namespace abut::detail
