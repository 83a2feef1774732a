#pragma once

// The time of impact of two convex parts, the first moving straight. For .cpp files.

#include <abut/query/detail/one_sided.hpp>
#include <abut/query/hit.hpp>

namespace abut::detail {

/// The motion of A relative to B.
template <int D>
struct Path {
    DVec<D> direction{0.0};  ///< unit vector
    double length = 0;
};

template <int D>
struct LinearImpact {
    double along = 0;     ///< how far A has moved
    DVec<D> normal{0.0};  ///< unit vector from A to B
    DVec<D> point{0.0};   ///< the point of contact, with A there and B at its start
    bool started_inside = false;
    Feature feature;  ///< of B
};

/// The limit on iterations. Each covers all of the known gap, so a few suffice mostly.
inline constexpr int linear_sweep_max_iterations = 64;

/// Options beside the two parts.
template <int D>
struct SweepOptions {
    Cache* cache = nullptr;                            ///< warm start; null: none
    Trace<D>* trace = nullptr;                         ///< records every step
    int max_iterations = linear_sweep_max_iterations;  ///< beyond this limit the parts count as touching where they
                                                       ///< are, which is early and never late
};

/// The first impact of A, moving along the path, and B; `index` is the number of B's part. Returns false, and leaves
/// `impact` unspecified, if there is none.
///
/// The signed distance of convex sets is a convex function of the length of a straight motion. So the plane that
/// separates the parts now still separates them until the motion has crossed the gap before it. Advancing by that
/// length is a step of Newton's method on a convex function: it never goes too far, and converges quadratically
/// (conservative advancement; Mirtich, "Impulse-based dynamic simulation", 1996; as a ray into the Minkowski
/// difference: van den Bergen, "Ray casting against general convex objects with application to continuous collision
/// detection", 2004). The result has both proofs: a point that both parts nearly share, and separating planes crossed
/// no earlier.
template <int D, class A, class B>
bool time_of_impact(const A& a, const Path<D>& path, const B& b, std::uint32_t index, const SweepOptions<D>& options,
                    LinearImpact<D>& impact);

/// Parts of any kinds that aren't both convex.
template <int D>
bool mixed_time_of_impact(const Part<D>& a, const Path<D>& path, const Part<D>& b, std::uint32_t index,
                          const SweepOptions<D>& options, LinearImpact<D>& impact);

/// The first impact at the fronts of one-sided parts. On a straight path the overlap is a single interval, so parts
/// that first touch at a back don't touch at a front later.
template <int D>
bool front_time_of_impact(const AnyPart<D>& a, const Path<D>& path, const AnyPart<D>& b, std::uint32_t index,
                          const SweepOptions<D>& options, LinearImpact<D>& impact) {
    if (!approaches_front(b, path.direction) || !approaches_front(a, -path.direction)) return false;
    const bool found = are_convex<D>(a, b) ? time_of_impact(a.convex(), path, b.convex(), index, options, impact)
                                           : mixed_time_of_impact(a, path, b, index, options, impact);
    return found && touch_at_fronts(a, b, impact.normal);
}

/// The first impact at fronts over all pairs of parts of two shapes.
template <int D>
bool first_impact(const View<D>& a, const Path<D>& path, const View<D>& b, const SweepOptions<D>& options,
                  LinearImpact<D>& impact);

}  // namespace abut::detail
