#pragma once

// The closed forms of ray_entry, one for each kind of core. Only for this folder. Features are numbered as in the core.

#include <abut/convex/polygon_soa.hpp>
#include <abut/convex/ray/ray_entry.hpp>

#include <array>
#include <limits>
#include <span>

namespace abut::detail {

/// Smaller values, relative to the coordinates, may be rounding.
inline constexpr double ray_tolerance = 1e-9;

template <int D>
RayEntry<D> ray_misses() {
    RayEntry<D> result;
    result.answer = RayAnswer::misses;
    return result;
}

/// Cyrus-Beck clipping: the part of a ray behind all planes of a polytope. The slope of a plane is the component of the
/// ray's direction along its normal.
struct RayCut {
    double lower = -std::numeric_limits<double>::infinity();  ///< where the ray gets behind the last plane
    double upper = std::numeric_limits<double>::infinity();   ///< where the ray leaves the first plane
    double slope_in = 0, slope_out = 0;                       ///< at these planes; not below zero

    /// For a ray of that length; heights up to `tolerance` may be rounding.
    RayAnswer answer(double length, double tolerance) const {
        if (lower > length) return RayAnswer::misses;
        if (upper < 0) return -upper * slope_out > tolerance ? RayAnswer::misses : RayAnswer::undecided;
        // Between the two, the ray is in front of one of the planes, and farthest behind both where their heights are
        // equal.
        if (lower > upper)
            return (lower - upper) * std::min(slope_in, slope_out) > 2 * tolerance ? RayAnswer::misses
                                                                                   : RayAnswer::undecided;
        return lower * slope_in > tolerance ? RayAnswer::enters : RayAnswer::undecided;
    }
};

// In the core's own frame, with a ball of `radius` around the core.

/// A box about the origin.
template <int D>
RayEntry<D> enter_box(const DRay<D>& ray, const DVec<D>& half, double radius);

/// A convex polygon of at least three corners, counter-clockwise, or a triangle in either winding.
RayEntry<2> enter_polygon(const DRay<2>& ray, std::span<const Vec2> points, double radius);

RayEntry<3> enter_polyhedron(const DRay<3>& ray, std::span<const Vec3> points, const Facets& facets, double radius);

/// The hull of two parallel discs.
RayEntry<3> enter_discs(const DRay<3>& ray, const DVec<3>& a, const DVec<3>& b, double radius_a, double radius_b);

// In any frame, with the corners relative to the ray's origin.

template <int D>
RayEntry<D> enter_capsule(const DRay<D>& ray, const DVec<D>& a, const DVec<D>& b, double radius);

/// Without thickness: a segment in 2D, a triangle in 3D.
RayEntry<2> enter_segment(const DRay<2>& ray, const DVec<2>& a, const DVec<2>& b);
RayEntry<3> enter_triangle(const DRay<3>& ray, const DVec<3>& a, const DVec<3>& b, const DVec<3>& c);

/// A triangle in 3D with a ball of `radius` around it.
RayEntry<3> enter_rounded_triangle(const DRay<3>& ray, const std::array<DVec<3>, 3>& corners, double radius);

}  // namespace abut::detail
