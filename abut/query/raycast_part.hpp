#pragma once

// Where a ray meets one convex part or half-space: in closed form where there is one, else by a search that takes any.
// For .cpp files.

#include <abut/convex/gjk/trace.hpp>
#include <abut/convex/ray/ray_entry.hpp>
#include <abut/query/feature.hpp>
#include <abut/shape/half_space.hpp>

namespace abut {

/// As `Hit` has it, but for the length of the normal.
template <int D>
struct PartHit {
    double along = 0;
    DVec<D> normal{0.0};  ///< of any length, out of the part
    bool started_inside = false;
    Feature feature;
};

/// False, and `hit` is of no use, where it doesn't.
template <int D>
bool part_hit(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace, PartHit<D>& hit);
template <int D>
bool part_hit(const DRay<D>& beam, const HalfSpaceView<D>& part, PartHit<D>& hit);

/// The same by the search alone: the beam runs up to the plane that parts its point from the part, and again from
/// there.
template <int D>
bool part_hit_by_advance(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace,
                         PartHit<D>& hit);

}  // namespace abut
