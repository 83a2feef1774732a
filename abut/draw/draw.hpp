#pragma once

// draw(canvas, thing, style) for shapes, query results, rays, boxes and worlds.
//
// Things with invalid numbers, NaN or infinite, are not drawn.

#include <abut/draw/canvas.hpp>
#include <abut/math/ray.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

namespace abut {

/// Draws a shape: in 2D the outline, filled if the style has a fill; in 3D the edges, and some lines around round
/// shapes; a fill covers the surface. Curves have an error of at most 1/800 of the shape's size. Half-spaces are
/// clipped to the visible box, and composite shapes are drawn part by part. The surface of a distance function is drawn
/// on a grid of 64 cells (24 in 3D) along the longest visible side.
template <int D>
void draw(Canvas<D>& canvas, const View<D>& shape, const Style& style = {});

template <int D, Shape S>
requires(dimension<S> == D) void draw(Canvas<D>& canvas, const S& shape, const Style& style = {}) {
    draw(canvas, View<D>(view(shape)), style);
}

/// A box of a broad phase, possibly empty or unbounded.
template <int D>
void draw(Canvas<D>& canvas, const Aabb<D>& box, const Style& style = {});

/// The boxes from which a broad phase was built.
template <int D>
void draw(Canvas<D>& canvas, std::span<const Aabb<D>> boxes, const Style& style = {});

/// An arrow; an infinite ray is clipped to the visible box.
template <int D>
void draw(Canvas<D>& canvas, const Ray<D>& ray, const Style& style = {});

/// The point and its normal.
template <int D>
void draw(Canvas<D>& canvas, const Hit<D>& hit, const Style& style = {});

/// Both points, the line between them, and the normal at the point on A.
template <int D>
void draw(Canvas<D>& canvas, const Closest<D>& closest, const Style& style = {});

/// Each point with the normal and a line as long as the depth there. Nothing if the shapes don't touch.
template <int D>
void draw(Canvas<D>& canvas, const Contact<D>& contact, const Style& style = {});

/// All items, including sensors, that reach into the visible box.
template <int D>
void draw(Canvas<D>& canvas, const World<D>& world, const Style& style = {});

/// A line with a head at its end, in the stroke's color.
template <int D>
void draw_arrow(Canvas<D>& canvas, const Vec<D>& from, const Vec<D>& to, const Style& style = {});

}  // namespace abut
