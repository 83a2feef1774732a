#pragma once

// A shape as a polytope: exactly if it has corners, else to within a tolerance, for queries of polytopes only.

#include <abut/shape/box.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/view/view.hpp>

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace abut {

/// Polygon or Polyhedron.
template <int D>
using PolytopeOf = std::conditional_t<D == 2, Polygon, Polyhedron>;

/// The limits on the corners of `polytope(shape, tolerance)`.
inline constexpr std::size_t max_polygon_vertices = 4096;
inline constexpr std::size_t max_polyhedron_vertices = 16384;

/// A tolerance below this fraction of the extent (the longest side of the bounding box) counts as this fraction: floats
/// are no finer.
inline constexpr double min_polytope_tolerance = 0x1p-18;

namespace detail {

template <class S>
inline constexpr bool has_corners = false;
template <int D>
inline constexpr bool has_corners<Convex<D>> = true;
template <int D>
inline constexpr bool has_corners<Aabb<D>> = true;
template <int D>
inline constexpr bool has_corners<Box<D>> = true;
template <int D>
inline constexpr bool has_corners<Segment<D>> = true;
template <int D>
inline constexpr bool has_corners<Triangle<D>> = true;
template <>
inline constexpr bool has_corners<Polygon> = true;
template <>
inline constexpr bool has_corners<Polyhedron> = true;
template <class S>
inline constexpr bool has_corners<At<S>> = has_corners<std::remove_cvref_t<S>>;
template <class S>
inline constexpr bool has_corners<Stretched<S>> = has_corners<std::remove_cvref_t<S>>;

/// Whether a set is the hull of corners: points or a box, without a radius.
template <int D>
bool has_corners_only(const Convex<D>& convex);

/// The corners of such a set before its placement; some may be no corners, or appear twice.
template <int D>
std::vector<Vec<D>> core_corners(const Convex<D>& convex);

template <int D>
PolytopeOf<D> polytope_of_corners(const Convex<D>& shape);
template <int D>
PolytopeOf<D> inscribed_polytope(const Convex<D>& shape, float tolerance);

}  // namespace detail

/// A shape that is a polytope by its type: Polygon, Polyhedron, Box, Aabb, Segment, Triangle, and those placed or
/// stretched. A view satisfies it too, and must be a view of one. Round shapes and shapes known by a support function
/// are none: `polytope(shape, tolerance)` makes one of them.
template <class S>
concept PolytopeShape = Shape<S> && detail::has_corners<S>;

/// The polytope of a shape's corners, each rounded to floats if the shape is placed or a rotated box. In space they are
/// those of `Polyhedron::build`. A shape that isn't finite, or a view of a shape that is no polytope, trips
/// ABUT_ASSERT; in release the result is then the point 0.
template <PolytopeShape S>
PolytopeOf<dimension<S>> polytope(const S& shape) {
    detail::clear_upper_halves();
    return detail::polytope_of_corners(view(shape));
}

Polygon polytope(const Aabb<2>& box);
Polyhedron polytope(const Aabb<3>& box);

inline Polygon polytope(const Polygon& polygon) {
    return polygon;
}
inline Polyhedron polytope(const Polyhedron& polyhedron) {
    return polyhedron;
}

/// A polytope inside any convex shape; no point of the shape is farther from it than `tolerance`, a length above zero.
/// Its corners are points of the surface, rounded to floats. A shape that has corners only gives `polytope(shape)`;
/// other shapes get corners where they stand out by more than the tolerance.
///
/// The error falls with the square of the number of corners in the plane, and with their number in space: a ball takes
/// 2.2 to 4.4 / sqrt(e) corners in the plane and about 6 / e in space, for a tolerance of e times its radius. If more
/// than `max_polygon_vertices` or `max_polyhedron_vertices` would be needed, the result is about as close as that many
/// allow; for a ball in space, within 1e-3 of its radius. A tolerance not above zero trips ABUT_ASSERT and counts as
/// the least.
template <Shape S>
requires std::same_as<detail::ViewOf<S>, detail::Convex<dimension<S>>> PolytopeOf<dimension<S>> polytope(
    const S& shape, float tolerance) {
    detail::clear_upper_halves();
    return detail::inscribed_polytope(view(shape), tolerance);
}

namespace detail {

/// The shape itself, or a polytope of a box whose view would round its corners.
template <class S>
const S& by_corners(const S& shape) {
    return shape;
}
template <int D>
PolytopeOf<D> by_corners(const Aabb<D>& box) {
    return polytope(box);
}

}  // namespace detail

}  // namespace abut
