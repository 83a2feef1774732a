#pragma once

// Where a ray enters the difference of two convex sets that are known by their supports: the moment at which the one,
// as it moves straight, touches the other.
//
// The line casts the difference onto a plane as a shadow, in which it is one point. First three points of the
// difference are found whose shadow holds that point, a portal, or a direction across the line along which the shadow
// doesn't reach it: then the line misses. A portal moves outwards, against the ray, by the farthest point across it,
// until there is none farther. So ends Minkowski portal refinement (Snethen, "XenoCollide", Game Programming Gems 7,
// 2008), which walks from a point inside; here the way is that of the ray itself. In the end a point of the difference
// and a plane before it agree where the ray enters.
//
// It answers only where it is sure by far more than rounding: of what goes well in, or clearly passes. For .cpp files.

#include <abut/convex/minkowski_difference.hpp>

namespace abut {

enum class PortalAnswer : std::uint8_t { undecided, misses, enters };

template <int D>
struct PortalHit {
    PortalAnswer answer = PortalAnswer::undecided;
    double along = 0;     ///< of the motion, at which they touch; may be below zero
    DVec<D> normal{0.0};  ///< of length 1, from A to B
    /// The face of A - B that is entered, weighted where it is; seen from where A begins.
    std::array<DifferencePoint<D>, static_cast<std::size_t>(D)> corners;
    std::array<double, static_cast<std::size_t>(D)> weights{};
};

/// What the caller must be sure of.
struct PortalNeeds {
    double doubt;  ///< how far two bounds may be apart
    double depth;  ///< how deep the line must go in, or how far it must pass
};

/// A, moving along `direction` of length 1, and B, without their balls.
template <int D>
PortalHit<D> enter_difference(const Convex<D>& a, const Convex<D>& b, const DVec<D>& direction,
                              const PortalNeeds& needs);

}  // namespace abut
