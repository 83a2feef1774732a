#pragma once

// The Voronoi regions of a shape's features: the points closer to a corner, edge or face than to any other.
// `closest_feature` names the feature by these regions.

#include <abut/draw/canvas.hpp>
#include <abut/shape/view/view.hpp>

namespace abut {

/// The result of `voronoi`. Refers to the shape and must not outlive it.
template <int D>
struct Voronoi {
    View<D> shape;
};

template <Shape S>
Voronoi<dimension<S>> voronoi(const S& shape) {
    return {view(shape)};
}

/// draw(canvas, voronoi(shape), style). The shape itself is not drawn.
///
/// In 2D: the borders within the visible box; the interior is divided among the edges. With a fill, the regions of
/// edges have it, and those of corners at half the opacity.
///
/// In 3D: only the borders outside, as walls on the edges of the faces. They are cut off at half the shape's size, and
/// their upper ends lie at a constant distance from the shape. A fill covers the walls.
///
/// For a rounded shape, the regions of its core. Nothing for composite shapes, half-spaces, points and balls, and for
/// shapes without corners (`has_features`).
template <int D>
void draw(Canvas<D>& canvas, const Voronoi<D>& voronoi, const Style& style = {});

}  // namespace abut
