#pragma once

// The closed forms behind ray_entry, one for each kind of core. Not for others. The corners of a feature are named as
// the core has them.

#include <abut/convex/ray_entry.hpp>
#include <abut/convex/sides.hpp>

#include <limits>
#include <span>

namespace abut {

/// What is no more than this, in parts of the numbers seen, may be rounding.
inline constexpr double ray_doubt = 1e-9;

template <int D>
RayEntry<D> ray_misses() {
    RayEntry<D> result;
    result.answer = RayAnswer::misses;
    return result;
}

/// The part of a beam behind all planes of a polytope, as far as it has been cut. A plane is come through at a slope:
/// how much of the beam's direction goes across it.
struct RayCut {
    double lower = -std::numeric_limits<double>::infinity();  ///< where it goes behind the last of them
    double upper = std::numeric_limits<double>::infinity();   ///< where it comes out before the first
    double slope_in = 0, slope_out = 0;                       ///< there; not below zero

    /// Of a beam of that length, where heights up to `doubt` may be rounding.
    RayAnswer answer(double length, double doubt) const {
        if (lower > length) return RayAnswer::misses;
        if (upper < 0) return -upper * slope_out > doubt ? RayAnswer::misses : RayAnswer::undecided;
        // Between the two it is before one plane or the other, farthest behind both where they are equal.
        if (lower > upper)
            return (lower - upper) * std::min(slope_in, slope_out) > 2 * doubt ? RayAnswer::misses
                                                                               : RayAnswer::undecided;
        return lower * slope_in > doubt ? RayAnswer::enters : RayAnswer::undecided;
    }
};

// In the core's own frame, with a ball of `radius` around the core.

/// A box about the origin.
template <int D>
RayEntry<D> enter_box(const Beam<D>& beam, const DVec<D>& half, double radius);

/// A convex polygon of at least three corners, counter-clockwise, or a triangle either way round.
RayEntry<2> enter_polygon(const Beam<2>& beam, std::span<const Vec2> points, double radius);

RayEntry<3> enter_polyhedron(const Beam<3>& beam, std::span<const Vec3> points, const Facets& facets, double radius);

/// The hull of two parallel discs.
RayEntry<3> enter_discs(const Beam<3>& beam, const DVec<3>& a, const DVec<3>& b, double radius_a, double radius_b);

// In any frame, with the corners seen from the beam's origin.

template <int D>
RayEntry<D> enter_capsule(const Beam<D>& beam, const DVec<D>& a, const DVec<D>& b, double radius);

/// Of no thickness: a segment of the plane, a triangle in space.
RayEntry<2> enter_segment(const Beam<2>& beam, const DVec<2>& a, const DVec<2>& b);
RayEntry<3> enter_triangle(const Beam<3>& beam, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c);

}  // namespace abut
