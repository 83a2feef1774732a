#pragma once

// The regions of a shape's corners, edges and faces: all that is closer to each than to any other. It is by these that
// `closest_feature` names the place closest to a point.

#include <abut/draw/canvas.hpp>
#include <abut/shape/view.hpp>

namespace abut {

/// What `voronoi` returns. Refers to the shape and must not outlive it.
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
/// In 2D the borders as far as the canvas shows, the inside divided among the edges. Where the style has a fill, the
/// regions of edges have it, and those of corners have it at half the opacity.
///
/// In 3D the borders outside alone: the walls that stand on the edges of the faces, cut off half the shape's size above
/// it, with the lines in which their upper ends lie, as far from the shape everywhere. A fill covers the walls.
///
/// Of rounded shapes the regions of the core. Nothing for composite shapes, half-spaces, points and balls, and what has
/// no corners (`has_features`).
template <int D>
void draw(Canvas<D>& canvas, const Voronoi<D>& voronoi, const Style& style = {});

}  // namespace abut
