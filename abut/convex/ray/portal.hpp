#pragma once

// The time of impact of two convex sets in linear motion, given by their support functions: a ray cast against their
// Minkowski difference.
//
// Projected along the line, the difference is a convex set and the line a point. First a portal is found: points of the
// difference whose projection contains that point, 3 of them in 3D. Or a direction across the line separates the
// projection from the point, and the line misses. Support queries along the portal's normal then move it outwards,
// against the ray, until no point is in front of it. This is the last phase of Minkowski portal refinement (Snethen,
// "XenoCollide", Game Programming Gems 7, 2008), with the ray itself in place of a ray from an inner point. At the end
// a point of the difference and a plane in front of it agree on the entry.
//
// It answers only if the answer is certain by far more than rounding: for lines that go well in, or clearly miss. For
// .cpp files.

#include <abut/convex/gjk/minkowski_difference.hpp>
#include <abut/convex/ray/ray_entry.hpp>

namespace abut::detail {

template <int D>
struct PortalHit {
    RayAnswer answer = RayAnswer::undecided;
    double along = 0;     ///< of the motion at the time of impact; may be below zero
    DVec<D> normal{0.0};  ///< of length 1, from A to B
    /// The face of A - B that the ray enters, with weights, relative to A at the start.
    std::array<DifferencePoint<D>, static_cast<std::size_t>(D)> corners;
    std::array<double, static_cast<std::size_t>(D)> weights{};
};

/// The tolerances of a proven answer.
struct PortalTolerances {
    double bound_gap;  ///< the largest gap between the two bounds
    double depth;      ///< how deep the line must go in, or how far it must miss
};

/// A moves along `direction` of length 1; the balls are ignored.
template <int D>
PortalHit<D> enter_difference(const Convex<D>& a, const Convex<D>& b, const DVec<D>& direction,
                              const PortalTolerances& tolerances);

}  // namespace abut::detail
