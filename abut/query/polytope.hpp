#pragma once

// A shape by its corners: exactly where it has some, else to within a tolerance. For what is asked of polytopes alone.

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

/// What `polytope(shape, tolerance)` makes has no more corners than this.
inline constexpr std::size_t most_polygon_corners = 4096;
inline constexpr std::size_t most_polyhedron_corners = 16384;

/// A tolerance below this times the extent (the longest side of the bounding box) counts as this: floats know no finer.
inline constexpr double least_polytope_tolerance = 0x1p-18;

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

/// Whether a set is the hull of corners: points or a box, without any ball around it.
template <int D>
bool has_corners_only(const Convex<D>& convex);

/// The corners of such a set before it is placed; perhaps some points that are none, or the same one twice.
template <int D>
std::vector<Vec<D>> core_corners(const Convex<D>& convex);

template <int D>
PolytopeOf<D> polytope_of_corners(const Convex<D>& shape);
template <int D>
PolytopeOf<D> inscribed_polytope(const Convex<D>& shape, float tolerance);

}  // namespace detail

/// A shape whose type says that it is a polytope: Polygon, Polyhedron, Box, Aabb, Segment, Triangle, and those placed
/// or stretched. A view counts as one, and must be of one. Round shapes and shapes known by a support function are
/// none: `polytope(shape, tolerance)` makes one of them.
template <class S>
concept PolytopeShape = Shape<S> && detail::has_corners<S>;

/// The same shape by its corners, each rounded to floats where it is placed or a turned box. In space they are those of
/// `Polyhedron::build`. What isn't finite, or a view of a shape that is no polytope, trips ABUT_ASSERT; in release the
/// result is then the point 0.
template <PolytopeShape S>
PolytopeOf<dimension<S>> polytope(const S& shape) {
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

/// A polytope inside of any convex shape that no point of the shape is farther from than `tolerance`, a length above
/// zero. Its corners are points of the surface, rounded to floats. What has corners only comes back as
/// `polytope(shape)`; corners of other shapes are found where they stand out by more than the tolerance.
///
/// The error falls with the square of the number of corners in the plane, with their number in space: a ball takes 2.2
/// to 4.4 / sqrt(e) corners and some 6 / e, for a tolerance of e times its radius. Where more than
/// `most_polygon_corners` or `most_polyhedron_corners` would be needed, the result is about as near as that many allow;
/// of a ball in space, within 1e-3 of its radius. A tolerance not above zero trips ABUT_ASSERT and counts as the least.
template <Shape S>
requires std::same_as<detail::ViewOf<S>, Convex<dimension<S>>> PolytopeOf<dimension<S>> polytope(const S& shape,
                                                                                                 float tolerance) {
    return detail::inscribed_polytope(view(shape), tolerance);
}

namespace detail {

/// The shape itself, but for a box whose view would round its corners.
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
