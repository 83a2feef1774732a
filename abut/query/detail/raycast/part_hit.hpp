#pragma once

// The hit of a ray with one part. A convex part takes a closed form if there is one, else conservative advancement.
// For .cpp files.

#include <abut/convex/gjk/trace.hpp>
#include <abut/convex/ray/ray_entry.hpp>
#include <abut/query/feature.hpp>
#include <abut/shape/view/part.hpp>

namespace abut {

/// Like `Hit`, with a normal of any length.
template <int D>
struct PartHit {
    double along = 0;
    DVec<D> normal{0.0};  ///< out of the part, of any length
    bool started_inside = false;
    Feature feature;
};

/// Returns false, and leaves `hit` unspecified, if the ray misses.
template <int D>
bool part_hit(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace, PartHit<D>& hit);
template <int D>
bool part_hit(const DRay<D>& beam, const detail::Part<D>& part, std::uint32_t index, Trace<D>* trace, PartHit<D>& hit);

/// Conservative advancement alone: the ray advances to the plane that separates its point from the part, and repeats
/// from there.
template <int D>
bool part_hit_by_advance(const DRay<D>& beam, const Convex<D>& part, std::uint32_t index, Trace<D>* trace,
                         PartHit<D>& hit);

}  // namespace abut
