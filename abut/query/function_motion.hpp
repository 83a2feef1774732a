#pragma once

// Rays and sweeps at what is known by its distance alone. For .cpp files.
//
// A ray runs as far as the distance tells that nothing is near (sphere tracing; Hart, "Sphere tracing: a geometric
// method for the antialiased ray tracing of implicit surfaces", 1996), and where the function knows its cells, from
// cell to cell. What moves goes on by as much as it is away, over how fast any of its points comes nearer (conservative
// advancement; Mirtich, "Impulse-based dynamic simulation", 1996). Steps are bounded: of what is left when half of them
// are used up, none is less than its share, so that what is thinner may be missed; a field's walls are not, by rays.

#include <abut/query/function_pairs.hpp>
#include <abut/query/raycast_part.hpp>
#include <abut/query/sweep_part.hpp>
#include <abut/query/turning_search.hpp>

namespace abut {

/// The bound on steps of a ray, and of a sweep, each of which costs a distance.
inline constexpr int function_ray_most_steps = 1024, function_sweep_most_steps = 256;

template <int D>
bool part_hit(const DRay<D>& beam, const DistanceFunction<D>& part, PartHit<D>& hit);

template <int D, class A, class B>
requires FunctionPair<A, B>
bool part_touch(const A& a, const Path<D>& path, const B& b, std::uint32_t index, const SweepOptions<D>& options,
                PartTouch<D>& touch);

template <int D, class A, class B>
requires FunctionPair<A, B>
bool first_meeting(const A& a, const RigidPath<D>& path_a, const B& b, const RigidPath<D>& path_b,
                   const TurningLimits& limits, const SearchOptions<D>& options, Meeting<D>& meeting);

}  // namespace abut
