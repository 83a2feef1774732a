#pragma once

// draw(canvas, thing, style) for shapes, answers, rays, boxes and worlds.
//
// What can't be drawn, because a number of it is NaN or infinite where it may not be, is left out.

#include <abut/draw/canvas.hpp>
#include <abut/math/ray.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/box.hpp>
#include <abut/world/world.hpp>

namespace abut {

/// The outline in 2D, filled where the style says so. In 3D the edges, and of round shapes some lines around them;
/// a fill covers the surface. Curves are right to 1/800 of the shape's size. Half-spaces are cut off at what the canvas
/// shows, composite shapes drawn part by part, of
/// distance functions the surface as a grid of 64 cells (in 3D 24) along the longest side of what is
/// shown of it tells.
template <int D>
void draw(Canvas<D>& canvas, const View<D>& shape, const Style& style = {});

template <int D, Shape S>
requires(dimension<S> == D) void draw(Canvas<D>& canvas, const S& shape, const Style& style = {}) {
    draw(canvas, View<D>(view(shape)), style);
}

/// A box of a broad phase, which may be empty or without bound.
template <int D>
void draw(Canvas<D>& canvas, const Aabb<D>& box, const Style& style = {});

/// What a broad phase was built from.
template <int D>
void draw(Canvas<D>& canvas, std::span<const Aabb<D>> boxes, const Style& style = {});

/// An arrow; of an endless ray as far as the canvas shows.
template <int D>
void draw(Canvas<D>& canvas, const Ray<D>& ray, const Style& style = {});

/// The point with its normal.
template <int D>
void draw(Canvas<D>& canvas, const Hit<D>& hit, const Style& style = {});

/// Both points, the line between them, and the normal at the one on A.
template <int D>
void draw(Canvas<D>& canvas, const Closest<D>& closest, const Style& style = {});

/// Each point with the normal, and with a line as long as the shapes are deep in one another there. Nothing where they
/// don't touch.
template <int D>
void draw(Canvas<D>& canvas, const Contact<D>& contact, const Style& style = {});

/// All items, sensors too, that reach into what the canvas shows.
template <int D>
void draw(Canvas<D>& canvas, const World<D>& world, const Style& style = {});

/// A line with a head at its end, in the color of the stroke.
template <int D>
void draw_arrow(Canvas<D>& canvas, const Vec<D>& from, const Vec<D>& to, const Style& style = {});

}  // namespace abut
