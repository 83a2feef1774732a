#pragma once

// How a shape known by its distance is drawn: where the distance is 0, simplex by simplex of a grid. Behind `draw`.

#include <abut/draw/canvas.hpp>
#include <abut/shape/distance_function.hpp>

namespace abut {

template <int D>
void draw_function(Canvas<D>& canvas, const DistanceFunction<D>& function, const Style& style);

}  // namespace abut
